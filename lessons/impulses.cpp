#include "lessons/impulses.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <tuple>

#include "lessons/recording.h"
#include "src2d/recorder.h"

namespace merge2d {
namespace {

/// How many contacts there are after each step.
std::vector<std::size_t> contactsPerStep(const Recording& recording) {
  std::vector<std::size_t> out(static_cast<std::size_t>(recording.steps) + 1);
  for (const ContactTrack& track : recording.contacts) {
    for (const Span& span : track.spans) {
      for (std::int64_t i = 0; i < span.count; ++i) {
        ++out[static_cast<std::size_t>(span.first + i)];
      }
    }
  }
  return out;
}

/// The steps in which bodies met, merged or came apart; those with most of that first.
std::vector<std::int64_t> eventfulSteps(const Recording& recording) {
  std::map<std::int64_t, int> count;
  for (const TimedEvent& e : recording.events) {
    const bool counts = e.event.type == EventType::Impact || e.event.type == EventType::Merge ||
                        e.event.type == EventType::Unmerge;
    if (counts) ++count[e.step];
  }
  std::vector<std::int64_t> out;
  for (const auto& [step, events] : count) out.push_back(step);
  std::ranges::stable_sort(out, std::greater{}, [&](std::int64_t step) { return count[step]; });
  return out;
}

/// Steps from 1 on, the ones most worth a look first.
std::vector<std::int64_t> byWorth(const Recording& recording,
                                  const std::vector<std::int64_t>& wanted) {
  std::vector<std::int64_t> out = wanted;
  std::ranges::copy(eventfulSteps(recording), std::back_inserter(out));
  for (std::int64_t step = 1; step <= recording.steps; ++step) out.push_back(step);
  std::vector<bool> taken(static_cast<std::size_t>(recording.steps) + 1);
  std::erase_if(out, [&](std::int64_t step) {
    if (step < 1 || step > recording.steps || taken[static_cast<std::size_t>(step)]) return true;
    taken[static_cast<std::size_t>(step)] = true;
    return false;
  });
  return out;
}

/// A contact of a stage, by its track.
std::map<std::int32_t, const ContactView*> byTrack(const Snapshot& seen,
                                                   const ContactTracks& tracks) {
  std::map<std::int32_t, const ContactView*> out;
  for (const ContactView& c : seen.contacts) {
    if (const auto track = tracks.of(c)) out.emplace(*track, &c);
  }
  return out;
}

void append(const ContactView& c, std::vector<float>& normal, std::vector<float>& tangent) {
  normal.push_back(static_cast<float>(c.lambda_n));
  tangent.push_back(static_cast<float>(c.lambda_t));
}

}  // namespace

void ContactTracks::update(const Recording& recording) {
  for (std::size_t i = index_.size(); i < recording.contacts.size(); ++i) {
    const ContactTrack& t = recording.contacts[i];
    index_.emplace(std::tuple{t.a, t.b, t.feature}, static_cast<std::int32_t>(i));
  }
}

std::optional<std::int32_t> ContactTracks::of(const ContactView& contact) const {
  const auto found = index_.find({contact.a, contact.b, contact.feature});
  if (found == index_.end()) return std::nullopt;
  return found->second;
}

ImpulsesInside impulsesInside(const StepRecord& record, const ContactTracks& tracks) {
  ImpulsesInside out{.step = record.step,
                     .sweeping = !record[Stage::SingleIterationPGS].own.empty(),
                     .contact = {},
                     .warm_n = {},
                     .warm_t = {},
                     .swept_n = {},
                     .swept_t = {},
                     .begin_n = {},
                     .begin_t = {},
                     .inner = {}};
  const auto swept = byTrack(record[Stage::SingleIterationPGS].after, tracks);
  const auto begin = byTrack(record[Stage::Unmerge].after, tracks);
  for (const auto& [track, warm] : byTrack(record[Stage::WarmStart].after, tracks)) {
    const auto after = swept.find(track), last = begin.find(track);
    if (after == swept.end() || last == begin.end()) continue;
    out.contact.push_back(track);
    append(*warm, out.warm_n, out.warm_t);
    append(*after->second, out.swept_n, out.swept_t);
    append(*last->second, out.begin_n, out.begin_t);
    out.inner.push_back(warm->internal ? 1 : 0);
  }
  return out;
}

void lookInside(Recording& recording, const std::vector<std::int64_t>& wanted,
                const std::function<void(std::int64_t)>& progress) {
  if (recording.every > 1) return;  // they were kept when it was recorded

  // Which steps.
  const std::vector<std::size_t> contacts = contactsPerStep(recording);
  std::vector<std::int64_t> worth = byWorth(recording, wanted);
  std::size_t total = 0;
  std::erase_if(worth, [&](std::int64_t step) {
    const std::size_t count = contacts[static_cast<std::size_t>(step)];
    if (count == 0 || total + count > kMostImpulses) return true;
    total += count;
    return false;
  });
  std::map<std::int64_t, std::size_t> place;
  for (std::size_t i = 0; i < worth.size(); ++i) place[worth[i]] = i;

  // The run once more: it gives the same numbers bit for bit.
  ContactTracks tracks;
  tracks.update(recording);
  Recorder recorder(recording.scene, recording.mode);
  recording.inside.assign(worth.size(), {});
  for (const auto& [step, i] : place) {
    while (recorder.world().steps() + 1 < step) {
      recorder.skip();
      if (progress) progress(recorder.world().steps());
    }
    recording.inside[i] = impulsesInside(recorder.record(), tracks);
    if (progress) progress(step);
  }
}

}  // namespace merge2d
