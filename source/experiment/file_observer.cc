#include "seedflow/experiment/file_observer.h"

#include <mpi.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/units.h"

namespace seedflow {

namespace {

/// A folder for one run, the same on all ranks; removed at the end.
class RunFolder {
 public:
  explicit RunFolder(MPI_Comm communicator) : comm(communicator) {
    static std::atomic<int> number{0};
    int id[2] = {static_cast<int>(getpid()), number++};
    MPI_Bcast(id, 2, MPI_INT, 0, comm);
    path = (std::filesystem::temp_directory_path() /
            ("seedflow-run-" + std::to_string(id[0]) + "-" + std::to_string(id[1])))
               .string();
  }
  ~RunFolder() {
    MPI_Barrier(comm);
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  std::string path;

 private:
  MPI_Comm comm;
};

/// What such a run says of itself (its report, above all) is gone with its folder.
class SilentRun {
 public:
  SilentRun() : kept{std::cout.rdbuf(nullptr), std::cerr.rdbuf(nullptr)} {}
  ~SilentRun() {
    std::cout.rdbuf(kept[0]);
    std::cerr.rdbuf(kept[1]);
  }
  SilentRun(const SilentRun&) = delete;
  SilentRun& operator=(const SilentRun&) = delete;

 private:
  std::streambuf* kept[2];
};

/// Says on standard error how many runs were made, every ten seconds at most, on the first process.
class Progress {
 public:
  void count() {
    ++n;
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const auto now = std::chrono::steady_clock::now();
    if (rank != 0 || now - said < std::chrono::seconds(10)) return;
    std::cerr << n << (n == 1 ? " run" : " runs") << " made by this process" << std::endl;
    said = now;
  }

 private:
  long n = 0;
  std::chrono::steady_clock::time_point said = std::chrono::steady_clock::now();
};

}  // namespace

Observer make_observer(const FileObserver& given) {
  const auto files = std::make_shared<FileObserver>(given);
  const auto progress = std::make_shared<Progress>();
  Observer observer;
  observer.observables = files->observables;
  observer.uncertainties = files->uncertainties;
  observer.random_entry = files->random_entry;
  observer.prepare = [files, progress](const std::string& prm, const std::vector<std::string>& overrides) {
    RunOptions options;
    options.prm = prm;
    options.overrides = overrides;
    PreparedRun run;
    files->read(options, [&](const Parameters& p) {  // mistakes are found before anything runs
      if (files->further_uncertainties) run.uncertainties = files->further_uncertainties(p);
    });
    run.time_step = files->time_step;
    run.value = [files, options](const std::string& path) {
      double value = 0;
      files->read(options, [&](const Parameters& p) { value = to_si(p.value(path), p.unit(path)); });
      return value;
    };
    run.text = [files, options](const std::string& path) {
      std::string value;
      files->read(options, [&](const Parameters& p) { value = p.value(path); });
      return value;
    };
    run.unit = [files, options](const std::string& path) {
      std::string unit;
      files->read(options, [&](const Parameters& p) { unit = p.unit(path); });
      return unit;
    };
    if (files->range)
      run.range = [files, options](const std::string& quantity) {
        CoordinateRange range;
        files->read(options, [&](const Parameters& p) { range = files->range(p, quantity); });
        return range;
      };
    run.simulate = [files, progress, options](const PreparedRun::Changes& changes,
                                              const std::vector<WantedValue>& wanted, MPI_Comm comm) {
      RunOptions changed = options;
      changed.comm = comm;
      for (const auto& [path, value] : changes) changed.overrides.push_back(path + "=" + exact_text(value));
      const RunFolder folder(comm);
      changed.output = folder.path;
      {
        const SilentRun silent;
        files->run(changed);
      }
      progress->count();
      MPI_Barrier(comm);  // rank 0 has written
      std::vector<double> values;
      for (const WantedValue& w : wanted) values.push_back(files->value(folder.path, w, changed));
      return values;
    };
    run.parameters_text = [files, options](const std::vector<std::string>& further) {
      RunOptions all = options;
      all.overrides.insert(all.overrides.end(), further.begin(), further.end());
      std::ostringstream text;
      files->read(all, [&](const Parameters& p) { p.write(text); });
      return text.str();
    };
    return run;
  };
  return observer;
}

}  // namespace seedflow
