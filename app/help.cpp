#include "app/help.h"

#include <sstream>

namespace merge2d {
namespace {

constexpr std::size_t kNamesWidth = 28, kDescriptionsWidth = 70;  // columns

}  // namespace

HelpFormatter::HelpFormatter() {
  column_width(kNamesWidth);
  label("SUBCOMMAND", "COMMAND");
  label("Positionals", "Scene");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
  const std::string text = Formatter::make_help(app, std::move(name), mode);
  return CLI::detail::find_and_replace(text, "\n\n\n", "\n\n");
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  const std::string value = option->get_type_name();
  return option->get_type_size() == 0 || value.empty() ? "" : " " + value;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return wrapped(option->get_description(), kDescriptionsWidth);
}

std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string out;
  std::size_t column = 0;
  for (std::string word; words >> word; column += word.size()) {
    const bool fits = column + 1 + word.size() <= width;
    if (column > 0) out += fits ? ' ' : '\n';
    column = column > 0 && fits ? column + 1 : 0;
    out += word;
  }
  return out;
}

}  // namespace merge2d
