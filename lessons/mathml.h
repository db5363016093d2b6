#pragma once
/// Formulas of a lesson's text: the part of LaTeX that mechanics needs, as MathML.

#include <string>
#include <string_view>

namespace merge2d {

/// Letters, digits, operators, ^ and _, groups in { }, \frac, \sqrt, \text, Greek letters and the
/// signs \cdot \times \le \ge \ne \perp \pm \to \infty \approx \sum. An unknown command is shown as
/// its name.
std::string mathMl(std::string_view latex);

}  // namespace merge2d
