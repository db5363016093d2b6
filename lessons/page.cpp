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
  out.array("traces", content.traces, [&](const NamedRecording& trace) {
    const EncodedTrace encoded = encode(trace.recording, encoding);
    out.open('{').field("label", trace.label);
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
{engine}<script>
{program}</script>
</body>
</html>
)";

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

std::string makePage(const PageContent& content, bool live) {
  const DataFolder player("built-in/player", embeddedPlayer());
  const std::string style = player.read("player.css"), program = player.read("player.js");
  const std::string engine =
      live ? fmt::format("<script type=\"text/plain\" id=\"engine\">{}</script>\n",
                         player.read("engine.b64"))
           : std::string();
  std::string page;
  for (const Encoding& encoding : encodings()) {
    page = fmt::format(kPage, fmt::arg("policy", live ? kLivePolicy : kPolicy),
                       fmt::arg("title", escapedHtml(content.title)), fmt::arg("style", style),
                       fmt::arg("data", forScript(dataOf(content, encoding))),
                       fmt::arg("engine", engine), fmt::arg("program", program));
    if (page.size() <= kPageBytes + engine.size()) break;
  }
  return page;
}

}  // namespace merge2d
