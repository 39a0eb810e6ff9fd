#include "seedflow/experiment/seed_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

struct Colour {
  double r, g, b;
};

// Told apart by people with any colour vision, and in print: the paper's red and blue first.
const Colour group_colours[] = {{0.80, 0.26, 0.18}, {0.16, 0.42, 0.69}, {0.93, 0.68, 0.13},
                                {0.27, 0.55, 0.33}, {0.55, 0.36, 0.60}, {0.45, 0.45, 0.45}};
constexpr int n_colours = 6;

std::string text_of(const Colour& c, double brightness, double white) {
  const auto level = [&](double v) {
    return static_cast<int>(std::lround(255 * std::clamp(v * brightness * (1 - white) + white, 0.0, 1.0)));
  };
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", level(c.r), level(c.g), level(c.b));
  return text;
}

constexpr double title_height = 26;  // [px]

double height_of(const SeedPicture& p) {
  return title_height + p.width * (p.window.top - p.window.bottom) / (p.window.right - p.window.left);
}

/// Draws one picture with its upper left corner at (left, top).
void draw(const SeedPicture& p, double left, double top, Svg& svg) {
  const double scale = p.width / (p.window.right - p.window.left);
  const auto px = [&](double x) { return left + (x - p.window.left) * scale; };
  const auto py = [&](double y) { return top + title_height + (p.window.top - y) * scale; };
  svg.text(left, top + 17, p.title, {14, "#1f2328", Svg::Anchor::start, true});
  svg.begin_clip(left, top + title_height, p.width, height_of(p) - title_height);
  const auto draw_lines = [&](const std::vector<PictureLine>& lines) {
    for (const PictureLine& line : lines) {
      std::vector<double> x, y;
      for (std::size_t i = 0; i < line.x.size(); ++i) x.push_back(px(line.x[i])), y.push_back(py(line.y[i]));
      svg.polyline(x, y, {line.colour, line.width, line.dash});
    }
  };
  draw_lines(p.behind);

  std::vector<std::size_t> order(p.discs.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return p.discs[a].depth < p.discs[b].depth; });
  double nearest = 0, farthest = 0;
  if (!order.empty()) farthest = p.discs[order.front()].depth, nearest = p.discs[order.back()].depth;
  const std::vector<double> visible =
      visible_shares(p.discs, p.discs.empty() ? 1 : p.discs.front().radius / 8);
  for (const std::size_t i : order) {
    const Disc& d = p.discs[i];
    if (visible[i] == 0) continue;
    const Colour& colour = group_colours[p.group.empty() ? 0 : p.group[i] % n_colours];
    const double near = nearest > farthest ? (d.depth - farthest) / (nearest - farthest) : 1;
    const double light = 0.62 + 0.38 * near, r = d.radius * scale;
    svg.circle(px(d.x), py(d.y), r, text_of(colour, 0.72 * light, 0), {"#222", 0.4, ""});
    svg.circle(px(d.x) - 0.08 * r, py(d.y) - 0.08 * r, 0.82 * r, text_of(colour, light, 0), Svg::no_stroke());
    svg.circle(px(d.x) - 0.3 * r, py(d.y) - 0.32 * r, 0.28 * r, text_of(colour, light, 0.45),
               Svg::no_stroke());
  }
  draw_lines(p.before);
  if (p.scale_bar > 0) {
    const double x = left + p.width - 12 - p.scale_bar * scale, y = top + height_of(p) - 10;
    svg.line(x, y, x + p.scale_bar * scale, y, {"#111", 2.5, ""});
    svg.text(x + 0.5 * p.scale_bar * scale, y - 6, printed_number(1e3 * p.scale_bar) + " mm",
             {12, "#111", Svg::Anchor::middle, false, true});
  }
  svg.end_clip();
  svg.rectangle(left, top + title_height, p.width, height_of(p) - title_height, "none", {"#bbb", 1, ""});
}

}  // namespace

std::string SeedPicture::svg() const {
  return picture_sheet({*this}, 1);
}

std::string picture_sheet(const std::vector<SeedPicture>& pictures, int columns) {
  constexpr double gap = 12;  // [px]
  double width = 0, height = 0;
  struct Place {
    double x, y;
  };
  std::vector<Place> places;
  for (std::size_t first = 0; first < pictures.size(); first += columns) {
    double x = 0, row = 0;
    for (std::size_t i = first; i < std::min(pictures.size(), first + columns); ++i) {
      places.push_back({x, height});
      x += pictures[i].width + gap;
      row = std::max(row, height_of(pictures[i]));
    }
    width = std::max(width, x - gap);
    height += row + gap;
  }
  Svg svg(std::max(1.0, width), std::max(1.0, height - gap + 2),
          pictures.empty() ? "no pictures" : pictures.front().title);
  for (std::size_t i = 0; i < pictures.size(); ++i) draw(pictures[i], places[i].x, places[i].y, svg);
  return svg.finish();
}

}  // namespace seedflow
