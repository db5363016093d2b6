#include "render/overlays.h"

#include <fmt/format.h>

#include <algorithm>

#include "src2d/core/error.h"
#include "src2d/core/suggest.h"

namespace merge2d {
namespace {

Overlays everything() {
  Overlays all;
  for (const OverlayEntry& entry : kOverlayTable) all.add(entry.overlay);
  return all;
}

Overlay overlayByName(std::string_view name) {
  const auto found = std::ranges::find(kOverlayTable, name, &OverlayEntry::name);
  if (found != kOverlayTable.end()) return found->overlay;
  std::array<std::string_view, kOverlays> names;
  std::ranges::transform(kOverlayTable, names.begin(), &OverlayEntry::name);
  throw InputError(fmt::format("unknown overlay '{}'{}", name, didYouMean(name, names)));
}

std::string_view trimmed(std::string_view s) {
  const std::size_t first = s.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(' ') - first + 1);
}

}  // namespace

const std::array<OverlayEntry, kOverlays> kOverlayTable = {{
    {Overlay::Labels, "labels", "C1, C2 … on the collections"},
    {Overlay::Scale, "scale", "scale bar"},
    {Overlay::Hud, "hud", "title, time, step, mode and counts"},
    {Overlay::Legend, "legend", "what the colours and marks mean"},
    {Overlay::Contacts, "contacts", "merged: square, active: ring, broken: cross"},
    {Overlay::Forces, "forces", "normal and friction forces"},
    {Overlay::Graph, "graph", "who is in contact with whom"},
    {Overlay::Welds, "welds", "what holds the collections together"},
    {Overlay::Boxes, "boxes", "oriented boxes of the collections"},
    {Overlay::Velocities, "velocities", "velocities of the bodies"},
    {Overlay::Names, "names", "names of the bodies"},
}};

Overlays Overlays::standard() {
  return Overlays().add(Overlay::Labels).add(Overlay::Scale).add(Overlay::Hud).add(Overlay::Legend);
}

Overlays parseOverlays(std::string_view list) {
  Overlays out = Overlays::standard();
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    const std::string_view word = trimmed(list.substr(0, comma));
    list.remove_prefix(std::min(comma + 1, list.size()));
    if (word.empty()) continue;
    if (word == "none") {
      out = {};
    } else if (word == "all") {
      out = everything();
    } else if (word == "standard") {
      out.add(Overlays::standard());
    } else if (word.front() == '-') {
      out.remove(overlayByName(word.substr(1)));
    } else {
      out.add(overlayByName(word));
    }
  }
  return out;
}

}  // namespace merge2d
