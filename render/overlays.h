#pragma once
/// The overlays over the bodies, by name.

#include <array>
#include <bitset>
#include <string>
#include <string_view>

namespace merge2d {

enum class Overlay : unsigned {
  Labels,      ///< C1, C2 … on the collections, a line around those without room for it
  Scale,       ///< scale bar
  Hud,         ///< title, time, step, mode and counts
  Legend,      ///< what the colours and marks mean
  Contacts,    ///< merged: square; active: ring; of a pair that just came apart: cross
  Forces,      ///< arrows of normal and friction forces
  Graph,       ///< who is in contact with whom
  Welds,       ///< which contacts hold a collection together
  Boxes,       ///< oriented boxes of the collections
  Velocities,  ///< arrows of the bodies' velocities
  Names,       ///< names of the bodies
};

struct OverlayEntry {
  Overlay overlay;
  std::string_view name;
  std::string_view meaning;
};
inline constexpr std::size_t kOverlays = 11;
/// All overlays with the names users give.
extern const std::array<OverlayEntry, kOverlays> kOverlayTable;

class Overlays {
 public:
  /// Labels, scale, hud and legend.
  static Overlays standard();

  bool has(Overlay overlay) const { return set_[static_cast<std::size_t>(overlay)]; }
  Overlays& add(Overlay overlay) {
    set_.set(static_cast<std::size_t>(overlay));
    return *this;
  }
  Overlays& remove(Overlay overlay) {
    set_.reset(static_cast<std::size_t>(overlay));
    return *this;
  }
  Overlays& add(const Overlays& more) {
    set_ |= more.set_;
    return *this;
  }
  friend bool operator==(const Overlays&, const Overlays&) = default;

 private:
  std::bitset<kOverlays> set_;
};

/// A list such as "contacts,forces": these on top of the standard ones. A list that starts with
/// "none" or "all" starts from there, and "-legend" takes one away. Throws InputError with a
/// suggestion: "unknown overlay 'contcts' (did you mean 'contacts'?)".
Overlays parseOverlays(std::string_view list);

}  // namespace merge2d
