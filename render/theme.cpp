#include "render/theme.h"

#include <fmt/format.h>

#include "src2d/core/error.h"
#include "src2d/core/suggest.h"

namespace merge2d {
namespace {

/// M. Okabe, K. Ito, "Color Universal Design", 2002: told apart by all kinds of vision. Yellow does
/// not stand out from white, so it needs its dark outline.
constexpr std::array<Color, Theme::kCollections> kOkabeIto = {
    rgb(0xe69f00),  // orange
    rgb(0x56b4e9),  // sky blue
    rgb(0x009e73),  // bluish green
    rgb(0xcc79a7),  // reddish purple
    rgb(0x0072b2),  // blue
    rgb(0xd55e00),  // vermilion
    rgb(0xf0e442),  // yellow
};

/// Each fill mixed towards `tint`, each outline from the fill towards `edge`.
std::array<Finish, Theme::kCollections> collectionFinishes(Color tint, double tinted, Color edge,
                                                           double edged) {
  std::array<Finish, Theme::kCollections> finishes;
  for (std::size_t i = 0; i < finishes.size(); ++i) {
    finishes[i] = {mix(kOkabeIto[i], tint, tinted), mix(kOkabeIto[i], edge, edged)};
  }
  return finishes;
}

constexpr Color kWhite = rgb(0xffffff);
constexpr Color kBlack = rgb(0x000000);

Theme makeLight() {
  Theme t;
  t.name = "light";
  t.background = kWhite;
  t.ink = rgb(0x1f2328);
  t.ink_soft = rgb(0x59636e);
  t.collections = collectionFinishes(kWhite, 0.08, kBlack, 0.55);
  t.free = {rgb(0x737b86), rgb(0x2b3036)};
  t.asleep = {rgb(0xd9dce0), rgb(0x868d96)};
  t.fixed = {rgb(0xf3f4f6), rgb(0x4b525b)};
  t.hatch = rgb(0xb9bfc7);
  t.magnet = rgb(0xb5179e);
  t.spring = rgb(0x4b525b);
  t.merged_contact = rgb(0x1f2328);
  t.active_contact = rgb(0x1f2328);
  t.broken_contact = rgb(0xc1121f);
  t.normal_force = rgb(0x1f2328);
  t.friction_force = rgb(0xc2185b);
  t.internal_force = rgb(0x1a5fb4);
  t.velocity = rgb(0x0b6e4f);
  t.graph = rgb(0x1f2328);
  t.box = rgb(0x1f2328);
  t.lines = {t.ink, rgb(0x0072b2), rgb(0xd55e00), rgb(0x009e73)};
  t.rim = kWhite;
  return t;
}

Theme makeDark() {
  Theme t;
  t.name = "dark";
  t.background = rgb(0x14171c);
  t.ink = rgb(0xe8ebf0);
  t.ink_soft = rgb(0xa2abb8);
  // Here the fills stand out by themselves, and the lines between them are darker still.
  t.collections = collectionFinishes(kWhite, 0.06, t.background, 0.8);
  t.free = {rgb(0x656e7a), rgb(0x1f242b)};
  t.asleep = {rgb(0x3a414b), rgb(0x7c8693)};
  t.fixed = {rgb(0x1f242b), rgb(0xa2abb8)};
  t.hatch = rgb(0x4c5561);
  t.magnet = rgb(0xff7be5);
  t.spring = rgb(0xa2abb8);
  t.merged_contact = rgb(0xffffff);
  t.active_contact = rgb(0xffffff);
  t.broken_contact = rgb(0xff6b6b);
  t.normal_force = rgb(0xffffff);
  t.friction_force = rgb(0xff80b5);
  t.internal_force = rgb(0x7db8ff);
  t.velocity = rgb(0x5fe0b0);
  t.graph = rgb(0xe8ebf0);
  t.box = rgb(0xe8ebf0);
  t.lines = {t.ink, rgb(0x56b4e9), rgb(0xe69f00), rgb(0x009e73)};
  t.rim = t.background;
  return t;
}

Theme makePrint() {
  Theme t = makeLight();
  t.name = "print";
  t.ink = kBlack;
  t.ink_soft = rgb(0x404040);
  t.collections = collectionFinishes(kWhite, 0.3, kBlack, 1.0);
  t.free = {rgb(0x747474), kBlack};
  t.asleep = {rgb(0xe2e2e2), rgb(0x6e6e6e)};
  t.fixed = {kWhite, kBlack};
  t.hatch = rgb(0x808080);
  t.spring = kBlack;
  t.merged_contact = t.active_contact = t.normal_force = t.graph = t.box = kBlack;
  t.lines[0] = kBlack;
  return t;
}

}  // namespace

const Theme& lightTheme() {
  static const Theme theme = makeLight();
  return theme;
}

const Theme& darkTheme() {
  static const Theme theme = makeDark();
  return theme;
}

const Theme& printTheme() {
  static const Theme theme = makePrint();
  return theme;
}

const Theme& themeByName(std::string_view name) {
  for (const Theme* theme : {&lightTheme(), &darkTheme(), &printTheme()}) {
    if (theme->name == name) return *theme;
  }
  constexpr std::array<std::string_view, 3> names = {"light", "dark", "print"};
  throw InputError(fmt::format("unknown theme '{}'{}; there are light, dark and print", name,
                               didYouMean(name, names)));
}

}  // namespace merge2d
