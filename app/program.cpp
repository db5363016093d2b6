#include "app/program.h"

#include <algorithm>
#include <new>

#include "app/commands.h"
#include "app/console.h"
#include "app/interrupt.h"
#include "app/usage_error.h"
#include "src2d/core/error.h"
#include "src2d/core/suggest.h"

namespace merge2d {
namespace {

void addCommands(CLI::App& program, Action& action) {
  program.name("merge2d");
  program.set_version_flag("--version", "merge2d " MERGE2D_VERSION);
  program.require_subcommand(0, 1);
  addListCommand(program, action);
  addRunCommand(program, action);
  addRenderCommand(program, action);
}

}  // namespace

int runProgram(std::vector<std::string> arguments) {
  CLI::App program("Headless 2D simulator of adaptive merging of rigid bodies");
  Action action;
  addCommands(program, action);
  try {
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    program.parse(std::move(arguments));
    if (action) action();
    flushOutput();
    return kFine;
  } catch (const CLI::CallForVersion&) {
    print("merge2d " MERGE2D_VERSION "\n");
    return kFine;
  } catch (const CLI::CallForHelp&) {
    print(program.help());
    return kFine;
  } catch (const CLI::ParseError& error) {
    printError(error.what());
    return kWrongUsage;
  } catch (const UsageError& error) {
    printError(error.what());
    return kWrongUsage;
  } catch (const InputError& error) {
    printError(error.what());
    return kBadInput;
  } catch (const IoError& error) {
    printError(error.what());
    return kOutputFailed;
  } catch (const SimulationError& error) {
    printError(error.what());
    return kCheckFailed;
  } catch (const Interrupted&) {
    printError("interrupted");
    endByInterrupt();
  }
}

}  // namespace merge2d
