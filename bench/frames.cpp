/// Measures the renderer beside Cairo: 1,000 boxes in 1280 × 720, without and with 2,000 arrows,
/// drawn from the very same lists of shapes; and frame sequences as `merge2d render` writes them.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <thread>

#include "bench/measure.h"
#include "bench/peers/cairo_canvas.h"
#include "render/camera.h"
#include "render/frame.h"
#include "render/png.h"
#include "render/sequence.h"

namespace {

using namespace merge2d;
namespace fs = std::filesystem;

constexpr int kColumns = 40;
constexpr int kRows = 25;
constexpr double kSpacing = 1.5;  // [m]

double milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  return took.count();
}

/// A thousand boxes, each with one contact and its two forces.
struct Crowd {
  std::vector<BodyInfo> bodies;
  Snapshot snapshot;

  Crowd() {
    for (int i = 0; i < kColumns * kRows; ++i) {
      const BodyId id{static_cast<unsigned>(i)};
      BodyInfo info;
      info.mass = 1.0;
      info.shapes = {makeBox(1.0, 1.0)};
      bodies.push_back(info);

      BodyState body;
      body.id = id;
      body.x = kSpacing * Vec2(i % kColumns, i / kColumns);
      snapshot.bodies.push_back(body);

      ContactView contact;
      contact.a = contact.b = id;
      contact.x = body.x;
      contact.normal = Vec2::UnitY();
      contact.lambda_n = contact.lambda_t = 1.0;
      contact.state = ContactState::Sticking;
      snapshot.contacts.push_back(contact);
    }
  }

  /// Another picture than the last one.
  void turn() {
    for (BodyState& body : snapshot.bodies) body.angle += 0.05;
  }

  FrameStyle style(bool arrows) const {
    FrameStyle style;
    style.overlays = parseOverlays(arrows ? "none,forces" : "none");
    style.camera = fitCamera(snapshot, bodies, double{1280} / 720);
    style.step = 1.0;
    style.force_scale = 0.6;
    return style;
  }
};

struct Result {
  std::string picture;
  std::size_t shapes = 0, arrows = 0;
  double draw = 0.0, png = 0.0;              // [ms]
  double cairo_draw = 0.0, cairo_png = 0.0;  // [ms]
  double frames_per_second = 0.0;            // of a whole sequence
};

/// Draws and encodes one frame after the other, both ways in turn.
void measureFrames(Result& result, bool arrows, int frames) {
  Crowd crowd;
  const FrameStyle style = crowd.style(arrows);
  const BodyLooks looks(crowd.bodies);
  Canvas canvas(style.width, style.height);
  bench::CairoCanvas cairo(style.width, style.height);

  std::vector<double> draw, png, cairo_draw, cairo_png;
  for (int i = 0; i < frames; ++i) {
    crowd.turn();
    const Drawing drawing =
        composeFrame(canvas.text(), crowd.snapshot, crowd.bodies, looks, style, {});
    result.shapes = result.arrows = 0;
    for (const Layer& layer : drawing.layers) {
      result.shapes += layer.shapes.size();
      result.arrows += layer.arrows.size();
    }
    Picture image;
    draw.push_back(milliseconds([&] { image = canvas.draw(drawing); }));
    png.push_back(milliseconds([&] { encodePng(image); }));
    cairo_draw.push_back(milliseconds([&] { cairo.draw(drawing); }));
    cairo_png.push_back(milliseconds([&] { cairo.encodePng(); }));
  }
  result.draw = bench::median(draw);
  result.png = bench::median(png);
  result.cairo_draw = bench::median(cairo_draw);
  result.cairo_png = bench::median(cairo_png);
}

/// The whole way to the files, with as many workers as there are cores.
double sequenceFramesPerSecond(bool arrows, int frames) {
  const fs::path folder = fs::temp_directory_path() / "merge2d-bench-frames";
  fs::remove_all(folder);
  Crowd crowd;
  SequenceOptions options;
  options.folder = folder;
  options.workers = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const double ms = milliseconds([&] {
    SequenceWriter writer(crowd.bodies, crowd.style(arrows), options);
    for (int i = 0; i < frames; ++i) {
      crowd.turn();
      writer.add(crowd.snapshot);
    }
    writer.finish();
  });
  fs::remove_all(folder);
  return 1e3 * frames / ms;
}

void print(const std::vector<Result>& results) {
  fmt::print(
      "| picture | shapes | arrows | draw | PNG | Cairo: draw | Cairo: PNG | files per second, {} "
      "workers |\n|---|--:|--:|--:|--:|--:|--:|--:|\n",
      std::thread::hardware_concurrency());
  for (const Result& r : results) {
    fmt::print("| {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.0f} |\n", r.picture,
               r.shapes, r.arrows, r.draw, r.png, r.cairo_draw, r.cairo_png, r.frames_per_second);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures the renderer beside Cairo");
  bool quick = false;
  app.add_flag("--quick", quick, "Fewer frames");
  CLI11_PARSE(app, argc, argv);

  const int frames = quick ? 20 : 100;
  std::vector<Result> results;
  for (const bool arrows : {false, true}) {
    Result result;
    result.picture = arrows ? "with arrows" : "without arrows";
    measureFrames(result, arrows, frames);
    result.frames_per_second = sequenceFramesPerSecond(arrows, frames);
    results.push_back(result);
  }
  print(results);
  return 0;
}
