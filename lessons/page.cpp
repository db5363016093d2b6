#include "lessons/page.h"

#include <fmt/format.h>

#include "lessons/encode.h"
#include "lessons/folder.h"
#include "src2d/trace/json_text.h"

namespace merge2d {
namespace {

/// JSON inside of <script>: no '<' may end it or begin a comment.
std::string forScript(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

std::string dataOf(const PageContent& content, const Encoding& encoding) {
  JsonText out;
  out.open('{').field("title", content.title).key("lesson").raw(content.lesson);
  const CoursePlace& place = content.course;
  out.key("course").open('{').field("number", place.number).field("of", place.of);
  out.field("next", place.next_title).field("file", place.next_file).close('}');
  out.field("embed", content.embed).field("language", content.language);
  out.array("traces", content.traces, [&](const NamedRecording& trace) {
    const EncodedTrace encoded = encode(trace.recording, encoding);
    out.open('{').field("label", trace.label).field("world", trace.world);
    out.key("head").raw(encoded.head).field("data", encoded.data).close('}');
  });
  out.close('}');
  return std::string(out.text());
}

/// Nothing may be fetched, sent or framed: what the page needs is in it.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: "
    "blob:; base-uri 'none'; form-action 'none'";
/// The engine is WebAssembly, which a policy must allow by name.
constexpr const char* kLivePolicy =
    "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src "
    "'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'";

constexpr const char* kPage = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="generator" content="merge2d">
<title>{title}</title>
<style>
{style}</style>
</head>
<body>
<noscript><p>This page draws a recorded simulation; it needs JavaScript, but no network.</p></noscript>
<div id="app"></div>
<script type="application/json" id="data">{data}</script>
{licences}{engine}<script>
{program}</script>
</body>
</html>
)";

constexpr const char* kIndex = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="generator" content="merge2d">
<title>A course on adaptive merging</title>
<style>
body {{ margin: 0 auto; max-width: 46rem; padding: 24px 16px 64px; background: #f5f5f2; color: #1b2129; font: 17px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }}
h1 {{ font-size: 26px; line-height: 1.2; }} ol {{ padding: 0; list-style: none; counter-reset: n; display: grid; gap: 8px; }}
li {{ counter-increment: n; background: #fff; border: 1px solid #d9dbd7; border-radius: 8px; padding: 12px 16px 12px 56px; position: relative; }}
li::before {{ content: counter(n); position: absolute; left: 16px; top: 14px; width: 26px; line-height: 26px; text-align: center; border: 1.5px solid #7d8690; border-radius: 50%; font-size: 14px; font-weight: 650; }}
li p {{ margin: 2px 0 0; }} small {{ color: #525b66; }} a {{ color: inherit; font-weight: 650; display: inline-block; min-height: 28px; }} a:focus-visible {{ outline: 3px solid #1b2129; outline-offset: 2px; }}
@media (prefers-color-scheme: dark) {{ body {{ background: #101317; color: #e9ecf0; }} li {{ background: #191d23; border-color: #333a43; }} small {{ color: #a9b2bd; }} a:focus-visible {{ outline-color: #e9ecf0; }} }}
</style>
</head>
<body>
<main>
<h1>Bodies that move as one: a course on adaptive merging</h1>
<p>Each page is a lesson that runs by itself, without a network. Answers stay in this browser.</p>
<ol>
{items}</ol>
</main>
</body>
</html>
)";

/// The page in the finest encoding in which it has at most `bytes`, or in the coarsest. Nearly all
/// fit in the finest one; for the others half of the encodings are left out at a time, as each try
/// of a long run takes seconds.
template <class PageAs>
std::string finestThatFits(PageAs pageAs, std::size_t bytes) {
  const std::vector<Encoding>& all = encodings();
  std::string page = pageAs(all.front());
  if (page.size() <= bytes) return page;
  std::size_t too_large = 0, fits = all.size() - 1;
  page = pageAs(all.back());
  while (fits - too_large > 1) {
    const std::size_t middle = (too_large + fits) / 2;
    std::string tried = pageAs(all[middle]);
    if (tried.size() > bytes) {
      too_large = middle;
    } else {
      fits = middle;
      page = std::move(tried);
    }
  }
  return page;
}

}  // namespace

std::string escapedHtml(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string makeCourseIndex(const std::vector<CourseEntry>& entries) {
  std::string items;
  for (const CourseEntry& entry : entries) {
    items += fmt::format("<li><a href=\"{}\">{}</a><p>{}</p><small>about {} minutes</small></li>\n",
                         escapedHtml(entry.file), escapedHtml(entry.title),
                         escapedHtml(entry.summary), entry.minutes);
  }
  return fmt::format(kIndex, fmt::arg("policy", kPolicy), fmt::arg("items", items));
}

std::string makePage(const PageContent& content, bool live) {
  const DataFolder player("built-in/player", embeddedPlayer());
  const std::string style = player.read("player.css"), program = player.read("player.js");
  const DataFolder texts("built-in/licences", embeddedLicences());
  const auto block = [](const char* id, const std::string& text) {
    return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, text);
  };
  const std::string licences = block("licences", texts.read("page.txt"));
  const std::string engine = live ? block("engine-licences", texts.read("engine.txt")) +
                                        block("engine", player.read("engine.b64"))
                                  : std::string();
  const auto pageAs = [&](const Encoding& encoding) {
    return fmt::format(kPage, fmt::arg("policy", live ? kLivePolicy : kPolicy),
                       fmt::arg("title", escapedHtml(content.title)), fmt::arg("style", style),
                       fmt::arg("data", forScript(dataOf(content, encoding))),
                       fmt::arg("licences", licences), fmt::arg("engine", engine),
                       fmt::arg("program", program));
  };
  return finestThatFits(pageAs, live ? kLivePageBytes : kPageBytes);
}

}  // namespace merge2d
