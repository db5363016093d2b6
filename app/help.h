#pragma once
/// How help looks.

#include <CLI/CLI.hpp>
#include <string>

namespace merge2d {

/// CLI11's format, with wrapped descriptions and without its remarks about the parser.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

/// Breaks the text at spaces into lines of at most `width` characters.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace merge2d
