#include "lessons/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lessons/encode.h"
#include "src2d/scene/load.h"

namespace merge2d {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string pageOf(const std::string& title) {
  Scene scene = parseScene("format = 1\n[[body]]\ncircle = 0.5\n", "ball.toml");
  scene.title = title;
  PageContent content{.title = title, .lesson = "null", .traces = {}};
  content.traces.push_back({"merge", record(scene, {.steps = 5})});
  return makePage(content);
}

TEST(Page, WhatLooksLikeAScriptStaysText) {
  const std::string page = pageOf("<script>alert(1)</script><!--");
  EXPECT_THAT(page, HasSubstr("<title>&lt;script&gt;alert(1)&lt;/script&gt;&lt;!--</title>"));
  EXPECT_THAT(page, HasSubstr(R"("title":"\u003cscript>alert(1)\u003c/script>\u003c!--")"));
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<!--")));
}

TEST(Page, AsksTheNetworkForNothing) {
  const std::string page = pageOf("ball");
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const char* way :
       {"src=\"", "href=\"http", "@import", "fetch(", "XMLHttpRequest", "url(http"}) {
    EXPECT_THAT(page, Not(HasSubstr(way))) << way;
  }
}

TEST(Page, CarriesTheLicencesOfWhatIsInIt) {
  const std::string page = pageOf("ball");
  for (const char* holder : {"Arjun Barrett (fflate)", "the merge2d authors", "Erin Catto (Box2D)",
                             "Mozilla Public License Version 2.0", "LLVM Exceptions"}) {
    EXPECT_THAT(page, HasSubstr(holder));
  }
  EXPECT_THAT(page, HasSubstr("The above copyright notice and this permission notice shall be"));
}

TEST(Page, WithoutTheEngineItCarriesNoLicencesOfIt) {
  PageContent content{.title = "ball", .lesson = "null", .traces = {}};
  content.traces.push_back(
      {"merge", record(parseScene("[[body]]\ncircle = 0.5\n", "ball.toml"), {.steps = 5})});
  const std::string page = makePage(content, false);
  EXPECT_THAT(page, HasSubstr("Arjun Barrett (fflate)"));
  EXPECT_THAT(page, Not(HasSubstr("Erin Catto")));
}

TEST(Page, TheSameRunGivesTheSameBytes) { EXPECT_EQ(pageOf("ball"), pageOf("ball")); }

TEST(Page, FinerEncodingsComeFirst) {
  const Scene scene = parseScene("format = 1\n[[body]]\ncircle = 0.5\n", "ball.toml");
  const Recording recording = record(scene, {.steps = 200});
  std::size_t before = encode(recording, encodings().front()).data.size();
  for (const Encoding& encoding : encodings()) {
    const std::size_t size = encode(recording, encoding).data.size();
    EXPECT_LE(size, before);
    before = size;
  }
}

TEST(Page, HtmlIsEscaped) {
  EXPECT_EQ(escapedHtml("<a b='\"&'>"), "&lt;a b=&#39;&quot;&amp;&#39;&gt;");
}

}  // namespace
}  // namespace merge2d
