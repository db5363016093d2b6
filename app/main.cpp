#include "app/program.h"

int main(int argc, char** argv) { return merge2d::runProgram({argv + 1, argv + argc}); }
