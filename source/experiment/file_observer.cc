#include "seedflow/experiment/file_observer.h"

#include <mpi.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
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

}  // namespace

Observer make_observer(const FileObserver& given) {
  const auto files = std::make_shared<FileObserver>(given);
  Observer observer;
  observer.observables = files->observables;
  observer.uncertainties = files->uncertainties;
  observer.random_entry = files->random_entry;
  observer.prepare = [files](const std::string& prm, const std::vector<std::string>& overrides) {
    RunOptions options;
    options.prm = prm;
    options.overrides = overrides;
    files->read(options, [](const Parameters&) {});  // mistakes are found before anything runs
    PreparedRun run;
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
    run.simulate = [files, options](const PreparedRun::Changes& changes,
                                    const std::vector<WantedValue>& wanted, MPI_Comm comm) {
      RunOptions changed = options;
      changed.comm = comm;
      for (const auto& [path, value] : changes) changed.overrides.push_back(path + "=" + exact_text(value));
      const RunFolder folder(comm);
      changed.output = folder.path;
      files->run(changed);
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
