#pragma once
/// The colours with which the tests draw, a letter each.

#include <map>

#include "src2d/scene/image.h"

namespace merge2d {

/// ' ' white, '#' black, 'g' grey, 'b' blue, 'e' green, 'r' red, 'm' magenta, 'y' yellow, 'c' cyan,
/// 'w' almost white, 'q' nearly red, 't' transparent black, 'h' half transparent black.
inline const std::map<char, Image::Pixel> kColors = {
    {' ', {255, 255, 255, 255}}, {'#', {0, 0, 0, 255}},     {'g', {127, 127, 127, 255}},
    {'b', {0, 0, 255, 255}},     {'e', {0, 200, 0, 255}},   {'r', {255, 0, 0, 255}},
    {'m', {255, 0, 255, 255}},   {'y', {255, 255, 0, 255}}, {'c', {0, 255, 255, 255}},
    {'w', {246, 246, 246, 255}}, {'q', {237, 28, 36, 255}}, {'t', {0, 0, 0, 0}},
    {'h', {0, 0, 0, 128}},
};

}  // namespace merge2d
