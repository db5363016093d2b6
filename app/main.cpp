#include "app/called_name.h"
#include "app/console.h"
#include "app/interrupt.h"
#include "app/memory_limit.h"
#include "app/program.h"

int main(int argc, char** argv) {
  merge2d::openStandardStreams();
  merge2d::prepareSignals();
  merge2d::limitMemory(merge2d::defaultMemoryLimit());
  if (argc > 0) merge2d::setCalledName(argv[0]);
  return merge2d::runProgram({argv + 1, argv + argc});
}
