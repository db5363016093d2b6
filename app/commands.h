#pragma once
/// The commands: each function adds one to the program, with its options and its help. What a
/// command does is kept in `action` when it was the one that was called.

#include <CLI/CLI.hpp>
#include <functional>

namespace merge2d {

using Action = std::function<void()>;

void addListCommand(CLI::App& program, Action& action);
void addValidateCommand(CLI::App& program, Action& action);
void addRunCommand(CLI::App& program, Action& action);
void addRenderCommand(CLI::App& program, Action& action);
void addCompareCommand(CLI::App& program, Action& action);
void addLessonCommand(CLI::App& program, Action& action);
void addCyclesCommand(CLI::App& program, Action& action);
void addStepCommand(CLI::App& program, Action& action);
void addExplainCommand(CLI::App& program, Action& action);
void addDoctorCommand(CLI::App& program, Action& action);
void addCompletionCommand(CLI::App& program, Action& action);
void addStudyCommand(CLI::App& program, Action& action);

}  // namespace merge2d
