#pragma once
/// Colours of a whole picture.

#include <array>
#include <string>
#include <string_view>

#include "render/color.h"

namespace merge2d {

/// A filled thing and its boundary.
struct Finish {
  Color fill;
  Color outline;
};

struct Theme {
  static constexpr std::size_t kCollections = 7;
  static constexpr std::size_t kFaint = 6;  ///< the slot to be used last: yellow

  std::string name;
  Color background;
  Color ink;       ///< text and axes
  Color ink_soft;  ///< secondary text

  std::array<Finish, kCollections> collections;  ///< by slot; see render/palette.h
  Finish free;                                   ///< a dynamic body outside of every collection
  Finish asleep;
  Finish fixed;  ///< pinned or scripted
  Color hatch;   ///< stripes of fixed bodies
  Color magnet;  ///< boundary of a magnet that is on
  Color spring;

  Color merged_contact, active_contact, broken_contact;
  Color normal_force, friction_force, internal_force;
  Color velocity;
  Color graph;  ///< of contacts and of welds
  Color box;
  std::array<Color, 4> lines;  ///< of charts
  Color rim;                   ///< around marks, so that they stand out from any fill
};

const Theme& lightTheme();  ///< white background: slides and papers
const Theme& darkTheme();   ///< for dark pages and rooms
const Theme& printTheme();  ///< black boundaries and paler fills: also without colour

/// "light", "dark" or "print". Throws InputError with a suggestion.
const Theme& themeByName(std::string_view name);

}  // namespace merge2d
