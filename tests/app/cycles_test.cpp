#include <gmock/gmock.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

constexpr const char* kGraph =
    "pinned ground\nground A 1\nA B 1\nB ground 1\nB C 2\nC D 1  # a pivot\n";

class Cycles : public ProgramTest {
 protected:
  Cycles() { write("graph.txt", kGraph); }

  /// As a shell does it.
  Outcome shell(const std::string& line) const {
    const std::string command =
        "cd '" + folder().string() + "' && { " + line + "\n} > out.txt 2> err.txt";
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.out = read("out.txt");
    outcome.err = read("err.txt");
    return outcome;
  }
  const std::string program_ = "'" + (buildDir() / "merge2d").string() + "' cycles ";
};

TEST_F(Cycles, PrintsAVerdictPerPairAndTheGroups) {
  const Outcome outcome = run({"cycles", "graph.txt"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("B - C              2  yes       yes    2 contacts\n"));
  EXPECT_THAT(outcome.out, HasSubstr("C - D              1  no        no     a pivot\n"));
  EXPECT_THAT(outcome.out, HasSubstr("rigid    groups: 1\n  ground, A, B, C\n"));
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(Cycles, TheJsonIsTheContracts) {
  const Outcome outcome = run({"cycles", "graph.txt", "--json"});
  EXPECT_EQ(outcome.out,
            R"({"pairs":[{"a":"ground","b":"A","contacts":1,"triangle":true,"rigid":true},)"
            R"({"a":"A","b":"B","contacts":1,"triangle":true,"rigid":true},)"
            R"({"a":"B","b":"ground","contacts":1,"triangle":true,"rigid":true},)"
            R"({"a":"B","b":"C","contacts":2,"triangle":true,"rigid":true},)"
            R"({"a":"C","b":"D","contacts":1,"triangle":false,"rigid":false}],)"
            R"("groups":{"triangle":[["ground","A","B","C"]],"rigid":[["ground","A","B","C"]]}})"
            "\n");
}

TEST_F(Cycles, NamesAreUtf8) {
  write("latin1.txt",
        "K\xe4"
        "fer B 1\n");
  for (const char* option : {"--json", "--quiet"}) {
    const Outcome outcome = run({"cycles", "latin1.txt", option});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, HasSubstr("latin1.txt:1:2: expected text in UTF-8"));
    EXPECT_THAT(outcome.err, HasSubstr("1 | K\uFFFDfer B 1\n"));
  }
}

TEST_F(Cycles, AnEmptyGraphHasNoPairs) {
  write("empty.txt", "");
  EXPECT_EQ(run({"cycles", "empty.txt", "--json"}).out,
            "{\"pairs\":[],\"groups\":{\"triangle\":[],\"rigid\":[]}}\n");
  EXPECT_EQ(run({"cycles", "empty.txt"}).code, 0);
}

TEST_F(Cycles, ReadsFromAPipe) {
  const std::string expected = run({"cycles", "graph.txt", "--json"}).out;
  for (const std::string file : {"-", "/dev/stdin", ""}) {
    EXPECT_EQ(shell("cat graph.txt | " + program_ + file + " --json").out, expected) << file;
  }
  EXPECT_EQ(shell(program_ + "--json < graph.txt").out, expected);
}

TEST_F(Cycles, WithoutAGraphIsWrongUsage) {
  const Outcome outcome = run({"cycles"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("FILE is missing"));
}

TEST_F(Cycles, AMistakeIsShownAtItsPlace) {
  write("graph.txt", "pinned A\n\nA B x\n");
  const Outcome outcome = run({"cycles", "graph.txt"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.err,
            "error: graph.txt:3:5: expected a count of contacts, got 'x'\n"
            "    3 | A B x\n      |     ^\n");
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(shell("printf 'A A 1' | " + program_ + "-").err, StartsWith("error: <stdin>:1:3: "));
}

TEST_F(Cycles, AFileThatIsNotThereIsABadGraph) {
  EXPECT_EQ(run({"cycles", "nothing.txt"}).code, 3);
  EXPECT_THAT(run({"cycles", "nothing.txt"}).err, HasSubstr("there is no file nothing.txt"));
  EXPECT_EQ(run({"cycles", "."}).code, 3);
}

TEST_F(Cycles, WarnsOfPinnedBodiesThatTouchNothing) {
  write("graph.txt", "pinned gruond\nground A 2\n");
  EXPECT_THAT(run({"cycles", "graph.txt"}).err, HasSubstr("warning: graph.txt:1:8: "));
  EXPECT_THAT(run({"cycles", "graph.txt", "--quiet"}).err, IsEmpty());
}

TEST_F(Cycles, DrawsThePictureItIsAskedFor) {
  EXPECT_EQ(run({"cycles", "graph.txt", "--render", "graph.png", "-r", "320x160"}).code, 0);
  EXPECT_THAT(read("graph.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(files(), ElementsAre("graph.png", "graph.txt"));
  // It may be drawn again, but is not drawn over other files.
  EXPECT_EQ(run({"cycles", "graph.txt", "--render", "graph.png"}).code, 0);
  EXPECT_EQ(run({"cycles", "graph.txt", "--render", "graph.txt"}).code, 2);
  EXPECT_EQ(run({"cycles", "graph.txt", "--render", "no/folder.png"}).code, 4);
  EXPECT_EQ(run({"cycles", "graph.txt", "--render", "b.png", "--theme", "drak"}).code, 2);
}

}  // namespace
}  // namespace merge2d
