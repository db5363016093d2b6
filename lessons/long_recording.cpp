#include "lessons/long_recording.h"

#include <algorithm>
#include <iterator>

#include "lessons/impulses.h"
#include "lessons/ledger.h"
#include "lessons/snapshot_feed.h"
#include "src2d/recorder.h"

namespace merge2d {
namespace {

/// The impulses inside of the steps in which most happened, as many as kMostImpulses allows.
class InsideOfSteps {
 public:
  explicit InsideOfSteps(std::vector<ImpulsesInside>& out) : out_(out) {}

  void add(ImpulsesInside inside, std::size_t events) {
    if (inside.contact.empty()) return;
    total_ += inside.contact.size();
    const auto place = std::ranges::upper_bound(events_, events, std::ranges::greater{});
    const auto at = place - events_.begin();
    events_.insert(place, events);
    out_.insert(out_.begin() + at, std::move(inside));
    while (total_ > kMostImpulses) {
      total_ -= out_.back().contact.size();
      out_.pop_back();
      events_.pop_back();
    }
  }

 private:
  std::vector<ImpulsesInside>& out_;  ///< most events first
  std::vector<std::size_t> events_;   ///< of each
  std::size_t total_ = 0;             ///< contacts
};

/// A run that is looked into in every `out.every`-th step.
class LongRun {
 public:
  explicit LongRun(Recording& out)
      : out_(out), recorder_(out.scene, out.mode), feed_(out), inside_(out.inside) {
    recorder_.world().capture(seen_);
    feed_.add(seen_);
  }

  void step() {
    ++out_.steps;
    const bool full = out_.detail == Detail::Full && out_.steps % out_.every == 0;
    if (full) return lookInto();
    recorder_.skip();
    recorder_.world().captureMotion(seen_);
    feed_.add(seen_);
  }
  void finish() { feed_.finish(); }

 private:
  void lookInto() {
    StepRecord record = recorder_.record();
    feed_.add(record.after);
    std::ranges::copy(ledgerOf(record, out_.bodies), std::back_inserter(out_.ledger));
    tracks_.update(out_);
    inside_.add(impulsesInside(record, tracks_), record.after.events.size());
    keepOrder(record.notes, out_.steps, out_);
    seen_ = std::move(record.after);
  }

  Recording& out_;
  Recorder recorder_;
  SnapshotFeed feed_;
  ContactTracks tracks_;
  InsideOfSteps inside_;
  Snapshot seen_;
};

}  // namespace

void recordInKeyframes(Recording& out, std::int64_t steps,
                       const std::function<void(std::int64_t)>& progress) {
  LongRun run(out);
  while (out.steps < steps) {
    run.step();
    if (progress) progress(out.steps);
  }
  run.finish();
}

}  // namespace merge2d
