#include "lessons/markdown.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lessons/mathml.h"

namespace merge2d {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Markdown, AFormulaBecomesMathMl) {
  EXPECT_EQ(mathMl("x^2"), "<math><mrow><msup><mi>x</mi><mn>2</mn></msup></mrow></math>");
  EXPECT_THAT(mathMl("0 \\le w_n \\perp \\lambda_n \\ge 0"),
              HasSubstr("<mo>≤</mo><msub><mi>w</mi><mi>n</mi></msub><mo>⊥</mo>"));
  EXPECT_THAT(mathMl("\\frac{m v}{2}"),
              HasSubstr("<mfrac><mrow><mi>m</mi><mi>v</mi></mrow><mrow><mn>2</mn></mrow></mfrac>"));
  EXPECT_THAT(mathMl("v_c^+"), HasSubstr("<msubsup><mi>v</mi><mi>c</mi><mo>+</mo></msubsup>"));
  EXPECT_THAT(mathMl("9.81\\,\\text{m/s}"), HasSubstr("<mn>9.81</mn>"));
}

TEST(Markdown, AFormulaThatIsNotClosedHasAnEnd) {
  EXPECT_THAT(mathMl("\\frac{a"), HasSubstr("<mi>a</mi>"));
  EXPECT_THAT(mathMl("}}x_"), HasSubstr("<mi>x</mi>"));
  EXPECT_THAT(mathMl("<script>"), Not(HasSubstr("<script>")));
  EXPECT_THAT(mathMl(std::string(10000, '{')), HasSubstr("</math>"));
  std::string nested;
  for (int i = 0; i < 10000; ++i) nested += "\\frac";
  EXPECT_THAT(mathMl(nested), HasSubstr("</math>"));
}

TEST(Markdown, ALongFormulaIsReadToItsEnd) {
  std::string sum;
  for (int i = 0; i < 200; ++i) sum += "x_{i} + ";
  EXPECT_THAT(mathMl(sum + "z"), HasSubstr("<mi>z</mi>"));
}

TEST(Markdown, DollarsOfMoneyAndOfCodeAreNoFormulas) {
  EXPECT_THAT(markdownToHtml("It costs $5 and $6."), Not(HasSubstr("<math>")));
  EXPECT_THAT(markdownToHtml("`$x$`"), HasSubstr("<code>$x$</code>"));
  EXPECT_THAT(markdownToHtml("\\$x\\$"), HasSubstr("$x$"));
  EXPECT_THAT(markdownToHtml("with $h_1$ and $h_2$."),
              HasSubstr("and <math><mrow><msub><mi>h</mi><mn>2</mn></msub></mrow></math>."));
}

TEST(Markdown, ATableHasRowsAndCellsInMarkdown) {
  const std::string html =
      markdownToHtml("Before.\n\n| a | *b* |\n|---|---|\n| 1 | $x$ |\n\nAfter.\n");
  EXPECT_THAT(html, HasSubstr("<table><thead><tr><th>a</th><th><em>b</em></th></tr></thead>"));
  EXPECT_THAT(html, HasSubstr("<td>1</td><td><math>"));
  EXPECT_THAT(html, Not(HasSubstr("<p><table")));
  EXPECT_THAT(html, HasSubstr("<p>After.</p>"));
}

}  // namespace
}  // namespace merge2d
