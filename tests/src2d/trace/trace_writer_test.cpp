/// The format of traces, from snapshots written by hand; tests/app/run_test.cpp has whole runs.

#include "src2d/trace/trace_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "src2d/scene/load.h"
#include "src2d/world.h"

namespace merge2d {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::string> keysOf(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

/// The lines of a trace with these snapshots, parsed.
std::vector<Json> trace(const std::vector<Snapshot>& snapshots, const TraceOptions& options = {},
                        const std::vector<BodyInfo>& bodies = {}, const Scene& scene = {}) {
  std::stringstream text;
  TraceWriter writer(text, scene, Mode::Merge, bodies, options);
  for (const Snapshot& snapshot : snapshots) writer.add(snapshot);
  std::vector<Json> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(Json::parse(line));
  return lines;
}

Json step(const Snapshot& snapshot, const TraceOptions& options = {}) {
  return trace({snapshot}, options).at(1);
}

TEST(TraceWriter, BeginsWithAHeaderThatTellsEverything) {
  Scene scene;
  scene.name = "pair";
  scene.step = 0.02;
  scene.settings.merging.velocity = 0.03;
  const Json header = trace({}, {}, {}, scene).at(0);
  EXPECT_THAT(keysOf(header), ElementsAre("type", "format", "version", "scene", "mode", "h",
                                          "parameters", "columns", "bodies"));
  EXPECT_EQ(header["type"], "header");
  EXPECT_EQ(header["format"], "merge2d-trace");
  EXPECT_EQ(header["version"], 1);
  EXPECT_EQ(header["scene"], "pair");
  EXPECT_EQ(header["mode"], "merge");
  EXPECT_EQ(header["h"], 0.02);
  EXPECT_EQ(header["parameters"]["merging"]["velocity"], 0.03);
  EXPECT_EQ(header["parameters"]["merging"]["cycles"], "rigid");
  EXPECT_EQ(header["parameters"]["unmerging"]["ordering"], true);
  EXPECT_EQ(header["columns"].dump(),
            R"({"bodies":["id","x","y","angle","vx","vy","omega","collection","asleep"],)"
            R"("contacts":["a","b","feature","x","y","nx","ny","gap","lambda_n","lambda_t",)"
            R"("w_n","w_t","state","internal","new"]})");
}

TEST(TraceWriter, BeginsInTheWayByWhichTracesAreRecognised) {
  std::stringstream text;
  const TraceWriter writer(text, Scene{}, Mode::Merge, {});
  EXPECT_THAT(text.str(), StartsWith(std::string(kTraceStart)));
}

TEST(TraceWriter, ListsTheBodiesWithTheirShapes) {
  BodyInfo lens;
  lens.name = "a \"lens\"";
  lens.motion = Motion::Pinned;
  lens.mass = 2.0;
  lens.inertia = 0.5;
  lens.shapes = {Circle{{1, 2}, 0.25}, Polygon{{{0, 0}, {1, 0}, {0, 1}}}};
  BodyInfo magnet;
  magnet.magnet = true;
  const Json bodies = trace({}, {}, {lens, magnet}).at(0)["bodies"];
  EXPECT_EQ(bodies[0].dump(),
            R"({"id":0,"name":"a \"lens\"","motion":"pinned","mass":2,"inertia":0.5,)"
            R"("shapes":[{"circle":0.25,"at":[1,2]},{"polygon":[[0,0],[1,0],[0,1]]}]})");
  EXPECT_EQ(bodies[1]["magnet"], true);
}

TEST(TraceWriter, WritesAStepInTheOrderOfTheColumns) {
  Snapshot snapshot;
  snapshot.step = 7;
  snapshot.time = 0.07;
  BodyState body;
  body.id = BodyId{3};
  body.x = {1, 2};
  body.angle = 0.1;
  body.v = {-1, -2};
  body.omega = 5;
  body.asleep = true;
  snapshot.bodies = {body};
  ContactView contact;
  contact.a = BodyId{3};
  contact.b = BodyId{4};
  contact.feature = 9;
  contact.x = {0.5, 0.25};
  contact.normal = {0, 1};
  contact.gap = -0.001;
  contact.lambda_n = 2;
  contact.lambda_t = -1;
  contact.w_n = 0.01;
  contact.w_t = 0.02;
  contact.state = ContactState::Sliding;
  contact.internal = true;
  snapshot.contacts = {contact};

  const Json line = step(snapshot);
  EXPECT_THAT(keysOf(line), ElementsAre("type", "step", "t", "bodies", "contacts", "collections",
                                        "events", "stats"));
  EXPECT_EQ(line["step"], 7);
  EXPECT_EQ(line["t"], 0.07);
  EXPECT_EQ(line["bodies"][0].dump(), "[3,1,2,0.1,-1,-2,5,-1,true]") << "free: collection -1";
  EXPECT_EQ(line["contacts"][0].dump(),
            R"([3,4,9,0.5,0.25,0,1,-0.001,2,-1,0.01,0.02,"sliding",true,false])");
}

TEST(TraceWriter, WritesCollectionsWithTheirAnchors) {
  CollectionView floating;
  floating.id = CollectionId{4};
  floating.bodies = {BodyId{1}, BodyId{2}};
  floating.mass = 3;
  CollectionView anchored = floating;
  anchored.anchored = true;
  anchored.anchor = BodyId{0};
  Snapshot snapshot;
  snapshot.collections = {floating, anchored};
  const Json line = step(snapshot);
  EXPECT_EQ(line["collections"][0].dump(),
            R"({"id":4,"bodies":[1,2],"anchor":null,"mass":3,"inertia":0,"x":0,"y":0,"vx":0,)"
            R"("vy":0,"omega":0,"asleep":false})");
  EXPECT_EQ(line["collections"][1]["anchor"], 0);
}

TEST(TraceWriter, WritesEventsWithTheirReasons) {
  Snapshot snapshot;
  snapshot.events = {
      {EventType::Merge, BodyId{1}, BodyId{2}, CollectionId{0}, EventReason::None},
      {EventType::Unmerge, BodyId{1}, BodyId{2}, CollectionId{0}, EventReason::RelativeMotion}};
  const Json events = step(snapshot)["events"];
  EXPECT_EQ(events[0].dump(), R"({"type":"merge","a":1,"b":2,"collection":0,"reason":null})");
  EXPECT_EQ(events[1]["type"], "unmerge");
  EXPECT_EQ(events[1]["reason"], "relative-motion");
}

TEST(TraceWriter, WritesDecisionsWithTheirMarginsWhenAskedTo) {
  Decision decision;
  decision.a = BodyId{1};
  decision.b = BodyId{2};
  decision.stage = "Merge";
  decision.criterion = "relative-motion";
  decision.equation = "(17)";
  decision.value = 0.25;
  decision.threshold = 1.0;
  decision.count = 2;
  decision.needed = 3;
  decision.verdict = "wait";
  Snapshot snapshot;
  snapshot.decisions = {decision};
  EXPECT_FALSE(step(snapshot).contains("decisions"));
  EXPECT_EQ(step(snapshot, {.decisions = true})["decisions"][0].dump(),
            R"j({"a":1,"b":2,"stage":"Merge","criterion":"relative-motion","equation":"(17)",)j"
            R"("value":0.25,"threshold":1,"margin":0.75,"count":2,"needed":3,"verdict":"wait"})");
}

TEST(TraceWriter, LeavesSecondsOutWhenAskedTo) {
  const Json with = step({})["stats"];
  EXPECT_THAT(with["seconds"], SizeIs(kStages));
  EXPECT_THAT(keysOf(with["seconds"]).front(), "ContactDetection");
  Json without = step({}, {.timings = false})["stats"];
  EXPECT_FALSE(without.contains("seconds"));
  EXPECT_THAT(keysOf(without),
              ElementsAre("bodies", "active_bodies", "collections", "asleep", "contacts",
                          "internal_contacts", "residual", "max_penetration", "kinetic_energy",
                          "potential_energy", "momentum", "angular_momentum"));
}

TEST(TraceWriter, NumbersSurviveTheWayThereAndBack) {
  for (const double number : {0.1, 1.0 / 3.0, -1e-300, 5e-324, 1.7976931348623157e308, 123456789.0,
                              0.30000000000000004}) {
    Snapshot snapshot;
    snapshot.time = number;
    EXPECT_EQ(step(snapshot)["t"].get<double>(), number);
  }
  Snapshot zero;
  zero.time = -0.0;
  EXPECT_TRUE(std::signbit(step(zero)["t"].get<double>()));
}

TEST(TraceWriter, NumbersAreWrittenInTheFewestDigits) {
  JsonText text;
  text.row(0.1, 1.0, 100.0, 0.01, 1e-5, 1e22, -0.5);
  EXPECT_EQ(text.text(), "[0.1,1,100,0.01,1e-05,1e+22,-0.5]");
}

TEST(TraceWriter, WhatIsNotFiniteIsNull) {
  JsonText text;
  text.row(kNan, kInfinity, -kInfinity);
  EXPECT_EQ(text.text(), "[null,null,null]");
}

TEST(TraceWriter, AnyNameCanBeWritten) {
  for (const char* name : {"brick[0,1]", "a\"b\\c", "line\nbreak", "Ω", "\x7f"}) {
    JsonText text;
    text.value(name);
    EXPECT_EQ(Json::parse(text.text()), name);
  }
  JsonText text;
  text.value("not \xff UTF-8");
  EXPECT_EQ(Json::parse(text.text()), "not \xEF\xBF\xBD UTF-8");
}

TEST(TraceWriter, ARunGivesOneLineForEachStep) {
  const Scene scene = parseScene(R"(
      format = 1
      [[body]]
      name = "ground"
      motion = "pinned"
      at = [0, -0.5]
      box = [10, 1]
      [[body]]
      name = "box"
      at = [0, 0.5]
      box = [1, 1])",
                                 "pair.toml");
  World world(scene);
  std::stringstream text;
  TraceWriter writer(text, scene, world.mode(), world.bodies());
  for (int k = 0; k < 20; ++k) {
    world.step();
    writer.add(world.capture());
  }
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(Json::parse(line)["bodies"][1]["name"], "box");
  Json last;
  int lines = 0;
  for (; std::getline(text, line); ++lines) last = Json::parse(line);
  EXPECT_EQ(lines, 20);
  EXPECT_EQ(last["step"], 20);
  EXPECT_THAT(last["bodies"], SizeIs(2));
  EXPECT_THAT(last["contacts"], SizeIs(2));
  EXPECT_EQ(last["collections"][0]["anchor"], 0) << "the box is welded to the ground";
}

TEST(TraceWriter, DecisionsPointAtTheirGroupsWhichAreListedOnce) {
  Snapshot snapshot;
  snapshot.groups = {{BodyId{3}, BodyId{5}, BodyId{4}}};
  Decision d{.a = BodyId{3}, .b = BodyId{5}, .stage = "Merge", .criterion = "cycle"};
  d.group = 3;
  d.members = 0;
  snapshot.decisions = {d, {.criterion = "sliding"}};
  const Json line = step(snapshot, {.decisions = true});
  EXPECT_EQ(line["groups"], Json({{3, 5, 4}}));
  EXPECT_EQ(line["decisions"][0]["group"], 3);
  EXPECT_EQ(line["decisions"][0]["members"], 0);
  EXPECT_FALSE(line["decisions"][1].contains("group"));
  EXPECT_FALSE(step(snapshot).contains("groups"));
  EXPECT_FALSE(step({}, {.decisions = true}).contains("groups"));
}

}  // namespace
}  // namespace merge2d
