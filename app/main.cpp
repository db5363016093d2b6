#include "app/console.h"
#include "app/interrupt.h"
#include "app/memory_limit.h"
#include "app/program.h"

int main(int argc, char** argv) {
  merge2d::openStandardStreams();
  merge2d::prepareSignals();
  merge2d::limitMemory(merge2d::defaultMemoryLimit());
  return merge2d::runProgram({argv + 1, argv + argc});
}
