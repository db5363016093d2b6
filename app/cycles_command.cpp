#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/console.h"
#include "app/help.h"
#include "app/json.h"
#include "app/output_file.h"
#include "app/picture_file.h"
#include "app/render_options.h"
#include "app/usage_error.h"
#include "render/graph.h"
#include "render/png.h"
#include "render/svg.h"
#include "src2d/core/error.h"
#include "src2d/cycles/contact_graph.h"
#include "src2d/scene/file.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;
constexpr const char* kCyclesExamples = R"(Examples:
  printf 'A B 1\nB C 1\nC A 1\n' | merge2d cycles -
  merge2d cycles graph.txt --json
  merge2d cycles graph.txt --render graph.png
  merge2d cycles graph.txt --render figure.svg

A graph is text: a line 'pinned A B' names bodies that are fixed, and each other line a pair in
contact, 'A B 2', with the number of its contacts and, if they are known, their points:
'A B 2 0,0 1,0.5'. '#' begins a comment.)";

struct CyclesOptions : MessageOptions {
  std::string file;     ///< "-": standard input
  std::string picture;  ///< PNG file, or empty
  std::pair<int, int> size{960, 480};
  std::string theme = "light";
  bool force = false;
};

/// Whether somebody has sent the standard input here.
bool inputIsSent() {
  struct stat input {};
  return fstat(STDIN_FILENO, &input) == 0 && (S_ISFIFO(input.st_mode) || S_ISREG(input.st_mode));
}

/// Reads a file, a pipe or a device. Throws InputError when there is none.
ContactGraph readGraph(const std::string& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) {
    throw InputError(fmt::format("{} is a folder, not a contact graph", file));
  }
  const bool missing = status.type() == fs::file_type::not_found && file != "-";
  if (missing) throw InputError(fmt::format("there is no file {}", file));
  const FileKind kind{.what = "a contact graph", .most = GraphLimits::kFileBytes};
  return parseContactGraph(readFile(file, kind), nameOfFile(file));
}

std::vector<std::string> membersNames(const ContactGraph& graph,
                                      const std::vector<std::uint32_t>& bodies) {
  std::vector<std::string> names;
  for (const std::uint32_t i : bodies) names.push_back(graph.bodies[i]);
  return names;
}

std::string json(const ContactGraph& graph, const CycleVerdicts& verdicts) {
  Json out{{"pairs", Json::array()}, {"groups", Json::object()}};
  for (std::size_t i = 0; i < graph.pairs.size(); ++i) {
    const GraphPair& pair = graph.pairs[i];
    out["pairs"].push_back({{"a", graph.bodies[pair.a]},
                            {"b", graph.bodies[pair.b]},
                            {"contacts", pair.contacts},
                            {"triangle", verdicts.pair_triangle[i] != 0},
                            {"rigid", verdicts.pair_rigid[i] != 0}});
  }
  const auto groups = [&](const Groups& of) {
    Json list = Json::array();
    for (const auto& members : membersOf(of)) list.push_back(membersNames(graph, members));
    return list;
  };
  out["groups"]["triangle"] = groups(verdicts.triangle);
  out["groups"]["rigid"] = groups(verdicts.rigid);
  return out.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Tells the verdicts to people.
class Report {
 public:
  Report(const ContactGraph& graph, const CycleVerdicts& verdicts)
      : graph_(graph), verdicts_(verdicts), cycle_of_(graph.pairs.size(), kNoCycle) {
    for (std::size_t c = 0; c < verdicts.cycles.size(); ++c) {
      for (const std::uint32_t pair : verdicts.cycles[c]) cycle_of_[pair] = c;
    }
  }

  std::string text() const {
    std::string out;
    std::size_t width = 4;
    for (const GraphPair& pair : graph_.pairs) width = std::max(width, lengthOf(pairName(pair)));
    const auto row = [&](const std::string& pair, const std::string& contacts, const char* triangle,
                         const char* rigid, const std::string& why) {
      const std::string blanks(width - std::min(width, lengthOf(pair)), ' ');
      out += fmt::format("{}{}  {:>8}  {:<8}  {:<5}  {}", pair, blanks, contacts, triangle, rigid,
                         why);
      out.erase(out.find_last_not_of(' ') + 1);
      out += '\n';
    };
    row("pair", "contacts", "triangle", "rigid", "why");
    for (std::size_t i = 0; i < graph_.pairs.size(); ++i) {
      const GraphPair& pair = graph_.pairs[i];
      row(pairName(pair), std::to_string(pair.contacts), word(verdicts_.pair_triangle[i]),
          word(verdicts_.pair_rigid[i]), reason(i));
    }
    out += "\n" + groupLines("triangle", verdicts_.triangle) + groupLines("rigid", verdicts_.rigid);
    return out;
  }

 private:
  static constexpr std::size_t kNoCycle = ~std::size_t{0};

  static const char* word(std::uint8_t yes) { return yes != 0 ? "yes" : "no"; }

  /// In characters.
  static std::size_t lengthOf(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(
        text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
  }

  std::string pairName(const GraphPair& pair) const {
    return graph_.bodies[pair.a] + " - " + graph_.bodies[pair.b];
  }

  std::string reason(std::size_t i) const {
    const GraphPair& pair = graph_.pairs[i];
    const bool triangle = verdicts_.pair_triangle[i] != 0, rigid = verdicts_.pair_rigid[i] != 0;
    if (pair.contacts == 0) return "no contact";
    const bool generic = verdicts_.generic[pair.a] == verdicts_.generic[pair.b];
    const std::string degenerate =
        generic && !rigid ? "; degenerate: its points are in a special position" : "";
    if (pair.contacts > 1) return fmt::format("{} contacts{}", pair.contacts, degenerate);
    if (cycle_of_[i] != kNoCycle) return cycleName(cycle_of_[i]) + degenerate;
    if (triangle) return "inside a group" + degenerate;
    return rigid ? "inside a rigid group" : "a pivot" + degenerate;
  }

  std::string cycleName(std::size_t c) const {
    std::string name = "cycle";
    for (const std::uint32_t pair : verdicts_.cycles[c]) {
      name += (name == "cycle" ? " " : ", ") + pairName(graph_.pairs[pair]);
    }
    return name;
  }

  std::string groupLines(const char* criterion, const Groups& groups) const {
    const auto all = membersOf(groups);
    if (all.empty()) return fmt::format("{:<8} groups: none\n", criterion);
    std::string lines = fmt::format("{:<8} groups: {}\n", criterion, all.size());
    for (const auto& members : all) {
      lines += fmt::format("  {}\n", fmt::join(membersNames(graph_, members), ", "));
    }
    return lines;
  }

  const ContactGraph& graph_;
  const CycleVerdicts& verdicts_;
  std::vector<std::size_t> cycle_of_;  ///< per pair
};

void drawPicture(const CyclesOptions& options, const Theme& theme, const ContactGraph& graph,
                 const CycleVerdicts& verdicts) {
  const auto [width, height] = options.size;
  const std::string description = fmt::format("merge2d: contact graph of {} bodies and {} pairs",
                                              graph.bodies.size(), graph.pairs.size());
  if (options.picture.ends_with(".svg")) {
    Text text;
    const Drawing drawing = composeGraph(text, graph, verdicts, width, height, theme);
    writeFile(options.picture,
              toSvg(drawing, {.width = width, .height = height, .title = description}),
              {.everything = true});
    return;
  }
  Canvas canvas(width, height);
  savePng(options.picture, drawGraph(canvas, graph, verdicts, theme), {.description = description});
}

const Theme& themeOf(const CyclesOptions& options) {
  try {
    return themeByName(options.theme);
  } catch (const InputError& error) {
    throw UsageError(error.what());
  }
}

void judgeFile(const CyclesOptions& options) {
  check(options);
  const Theme& theme = themeOf(options);
  const std::string& picture = options.picture;
  if (!picture.empty() && !picture.ends_with(".png") && !picture.ends_with(".svg")) {
    throw UsageError(fmt::format(
        "--render draws PNG and SVG pictures, whose names end in .png and .svg, but got '{}'",
        picture));
  }
  if (!options.picture.empty()) requirePictureMayAppear(options.picture, options.force);
  const std::string file = options.file.empty() && inputIsSent() ? "-" : options.file;
  if (file.empty())
    throw UsageError("FILE is missing: a contact graph, or - for the standard input");
  if (file == "-" && isatty(STDIN_FILENO) == 1) {
    Console(options).note("Reading a contact graph from the terminal; Ctrl-D ends it.");
  }
  const ContactGraph graph = readGraph(file);
  const Console console(options);
  for (const std::string& warning : graph.warnings) console.warn(warning);
  const CycleVerdicts verdicts = judge(graph);
  if (!options.picture.empty()) {
    drawPicture(options, theme, graph, verdicts);
    console.note(fmt::format("drawn: {}", options.picture));
  }
  print(options.json ? json(graph, verdicts) : Report(graph, verdicts).text());
}

}  // namespace

void addCyclesCommand(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand(
      "cycles", "Say which contacts of a contact graph hold bodies together");
  command->footer(kCyclesExamples);
  const auto help = std::make_shared<HelpFormatter>();
  help->label("Positionals", "Graph");
  command->formatter(help);
  const auto options = std::make_shared<CyclesOptions>();
  command
      ->add_option("FILE", options->file,
                   "A contact graph as text; - is the standard input, and so is a pipe")
      ->type_name("");
  constexpr const char* kPictures = "Pictures";
  addOutputOption(
      *command, "--render", "FILE.png",
      [options](const std::string& s) { options->picture = readPath("--render", s); },
      "Draw the graph with the groups of both criteria")
      ->group(kPictures);
  addOption(
      *command, "-r,--resolution", "WxH",
      [options](const std::string& s) { options->size = readSize(s); },
      "Size of the picture in pixels (default: 960x480)")
      ->group(kPictures);
  addOption(
      *command, "--theme", "NAME", [options](const std::string& s) { options->theme = s; },
      "light (default), dark or print")
      ->group(kPictures);
  addContextOption(*command);
  command->add_flag("--force", options->force, "Overwrite files that are not ours")
      ->group("General");
  addMessageOptions(*command, *options);
  command->callback([&action, options] { action = [options] { judgeFile(*options); }; });
}

}  // namespace merge2d
