#pragma once
/// The text a scene was read from, for messages that show the place of a mistake.

#include <string>
#include <string_view>

#include "src2d/core/error.h"
#include "src2d/scene/toml.h"

namespace merge2d {

class SourceText {
 public:
  /// Keeps views of `text`, which must outlive it.
  SourceText(std::string name, std::string_view text);

  const std::string& name() const { return name_; }
  std::string_view text() const { return text_; }

  /// Throws the InputError `name:line:column: sentence`, followed by the line and a caret. What
  /// comes from elsewhere than this text (`--set merging.velocity=0.02`) is named by its path only.
  [[noreturn]] void fail(const toml::source_region& where, std::string_view sentence) const;

  /// "line 12", or the path of what comes from elsewhere: "--set body.a.name=b".
  std::string place(const toml::source_region& where) const;

  /// `name:line:column: sentence`, and the line with a caret below `column`.
  PlacedMessage message(const toml::source_position& where, std::string_view sentence) const;

  /// Line `number`, from 1, without its end; empty when there is none.
  std::string_view line(std::size_t number) const;

 private:
  std::string name_;
  std::string_view text_;
};

}  // namespace merge2d
