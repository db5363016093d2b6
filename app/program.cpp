#include "app/program.h"

#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <system_error>

#include "app/commands.h"
#include "app/console.h"
#include "app/help.h"
#include "app/interrupt.h"
#include "app/memory_limit.h"
#include "app/parse.h"
#include "app/usage_error.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

constexpr const char* kProgramExamples = R"(Examples:
  merge2d list                             the built-in scenes
  merge2d run tower-platform               simulate one, and sum it up
  merge2d render tower-platform            draw it to frames/tower-platform/
  merge2d compare dominoes                 how fast each mode is, and how near the reference
  merge2d study grid.toml -o thresholds    run it many times, with parameters that vary
  merge2d lesson tower-platform            write a page to step through it in a browser
  merge2d step books                       walk through it, stage by stage, and back
  merge2d explain tower-platform --at 599  why pairs merged, came apart, or did not
  merge2d validate my-scene.toml           check a scene of your own

'merge2d COMMAND --help' tells more. The result goes to the standard output, messages to the
standard error. Exit codes: 0 fine, 1 a check or the simulation failed, 2 wrong usage, 3 bad scene or
graph, 4 rendering, reading or writing failed. Pages such as docs/studies.md are installed in
share/doc/merge2d.)";

void addCommands(CLI::App& program, Action& action) {
  program.name("merge2d");
  program.formatter(std::make_shared<HelpFormatter>());
  program.set_help_flag("-h,--help", "Print this help and exit");
  program.set_version_flag("-V,--version", "merge2d " MERGE2D_VERSION,
                           "Print the version and exit");
  program.require_subcommand(0, 1);
  program.footer(kProgramExamples);
  addListCommand(program, action);
  addValidateCommand(program, action);
  addRunCommand(program, action);
  addRenderCommand(program, action);
  addCompareCommand(program, action);
  addStudyCommand(program, action);
  addLessonCommand(program, action);
  addCyclesCommand(program, action);
  addStepCommand(program, action);
  addExplainCommand(program, action);
  addDoctorCommand(program, action);
  addCompletionCommand(program, action);
  for (CLI::App* command : program.get_subcommands({})) command->group("Commands");
}

void run(std::vector<std::string> arguments) {
  CLI::App program("Headless 2D simulator of adaptive merging of rigid bodies");
  Action action;
  addCommands(program, action);
  if (parse(program, std::move(arguments))) action();
  flushOutput();
}

int fail(const std::exception& error, ExitCode code) {
  printError(error.what());
  return code;
}

}  // namespace

int runProgram(std::vector<std::string> arguments) {
  try {
    run(std::move(arguments));
    return kFine;
  } catch (const UsageError& error) {
    return fail(error, kWrongUsage);
  } catch (const InputError& error) {
    return fail(error, kBadInput);
  } catch (const SimulationError& error) {
    return fail(error, kCheckFailed);
  } catch (const Interrupted& interrupted) {
    printError(interrupted.what());
    endByInterrupt();
  } catch (const ReaderGone& error) {
    endByBrokenPipe();  // silently, as every filter does
    return fail(error, kOutputFailed);
  } catch (const MemoryLimitReached&) {
    printError(fmt::format("this needs more memory than the limit of {}; --memory-limit changes it",
                           memoryLimitText()));
    return kOutputFailed;
  } catch (const std::bad_alloc&) {
    printError("there is not enough memory: the system gives no more of it");
    return kOutputFailed;
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(
        IoError(fmt::format("cannot use {}: {}", error.path1().string(), error.code().message())),
        kOutputFailed);
  } catch (const std::system_error& error) {
    return fail(IoError(error.code().message()), kOutputFailed);
  } catch (const std::exception& error) {  // IoError
    return fail(error, kOutputFailed);
  }
}

}  // namespace merge2d
