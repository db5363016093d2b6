#include "src2d/trace/trace_writer.h"

#include "src2d/scene/names.h"
#include "src2d/trace/parameters.h"

namespace merge2d {
namespace {

// The header

void writeShape(JsonText& out, const ConvexShape& shape) {
  out.open('{');
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    out.field("circle", circle->radius).field("at", circle->center);
  } else {
    out.array("polygon", std::get<Polygon>(shape).vertices, [&](const Vec2& v) { out.value(v); });
  }
  out.close('}');
}

void writeBodyInfo(JsonText& out, std::size_t id, const BodyInfo& body) {
  out.open('{').field("id", id).field("name", body.name).field("motion", name(body.motion));
  out.field("mass", body.mass).field("inertia", body.inertia);
  out.array("shapes", body.shapes, [&](const ConvexShape& shape) { writeShape(out, shape); });
  if (body.magnet) out.field("magnet", true);
  out.close('}');
}

/// The constant data of the joints; absent in scenes without them.
void writeJointInfo(JsonText& out, const JointDesc& joint) {
  out.open('{').field("kind", nameOf(joint.kind)).field("a", joint.a);
  if (joint.b) {
    out.field("b", *joint.b);
  } else {
    out.field("b", nullptr);
  }
  out.close('}');
}

void writeColumns(JsonText& out, bool joints) {
  out.key("columns").open('{');
  out.key("bodies").row("id", "x", "y", "angle", "vx", "vy", "omega", "collection", "asleep");
  out.key("contacts")
      .row("a", "b", "feature", "x", "y", "nx", "ny", "gap", "lambda_n", "lambda_t", "w_n", "w_t",
           "state", "internal", "new");
  if (joints) out.key("joints").row("joint", "x", "y", "fx", "fy", "torque", "broken", "internal");
  out.close('}');
}

void writeHeader(JsonText& out, const Scene& scene, Mode mode,
                 const std::vector<BodyInfo>& bodies) {
  out.open('{').field("type", "header").field("format", "merge2d-trace");
  out.field("version", TraceWriter::kVersion).field("scene", scene.name).field("mode", name(mode));
  out.field("h", scene.step).key("parameters");
  writeParameters(out, scene);
  writeColumns(out, !scene.joints.empty());
  std::size_t id = 0;
  out.array("bodies", bodies, [&](const BodyInfo& body) { writeBodyInfo(out, id++, body); });
  if (!scene.joints.empty()) {
    out.array("joints", scene.joints, [&](const JointDesc& joint) { writeJointInfo(out, joint); });
  }
  out.close('}');
}

// A step; see writeColumns

void writeBody(JsonText& out, const BodyState& b) {
  out.row(b.id, b.x.x(), b.x.y(), b.angle, b.v.x(), b.v.y(), b.omega, b.collection, b.asleep);
}

void writeContact(JsonText& out, const ContactView& c) {
  out.row(c.a, c.b, c.feature, c.x.x(), c.x.y(), c.normal.x(), c.normal.y(), c.gap, c.lambda_n,
          c.lambda_t, c.w_n, c.w_t, name(c.state), c.internal, c.fresh);
}

void writeJoint(JsonText& out, std::size_t id, const JointView& j) {
  out.row(id, j.to.x(), j.to.y(), j.force.x(), j.force.y(), j.torque, j.broken, j.internal);
}

void writeCollection(JsonText& out, const CollectionView& c) {
  out.open('{').field("id", c.id);
  out.array("bodies", c.bodies, [&](BodyId b) { out.value(b); });
  if (c.anchored) {
    out.field("anchor", c.anchor);
  } else {
    out.field("anchor", nullptr);
  }
  out.field("mass", c.mass).field("inertia", c.inertia);
  out.field("x", c.x.x()).field("y", c.x.y()).field("vx", c.v.x()).field("vy", c.v.y());
  out.field("omega", c.omega).field("asleep", c.asleep).close('}');
}

/// The margin is what is left up to the threshold: negative beyond it.
void writeDecision(JsonText& out, const Decision& d) {
  out.open('{').field("a", d.a).field("b", d.b).field("stage", d.stage);
  out.field("criterion", d.criterion).field("equation", d.equation);
  out.field("value", d.value).field("threshold", d.threshold);
  out.field("margin", d.threshold - d.value).field("count", d.count).field("needed", d.needed);
  out.field("verdict", d.verdict);
  if (d.group >= 0) out.field("group", d.group);
  if (d.members >= 0) out.field("members", d.members);
  out.close('}');
}

void writeGroup(JsonText& out, const Group& group) {
  out.open('[');
  for (const BodyId body : group) out.value(body);
  out.close(']');
}

void writeSeconds(JsonText& out, const Stats& stats) {
  out.key("seconds").open('{');
  for (std::size_t i = 0; i < kStages; ++i) {
    out.field(name(static_cast<Stage>(i)), stats.seconds[i]);
  }
  out.close('}');
}

void writeStats(JsonText& out, const Stats& s, bool timings) {
  out.key("stats").open('{').field("bodies", s.bodies).field("active_bodies", s.active_bodies);
  out.field("collections", s.collections).field("asleep", s.asleep);
  out.field("contacts", s.contacts).field("internal_contacts", s.internal_contacts);
  if (timings) writeSeconds(out, s);
  out.field("residual", s.residual).field("max_penetration", s.max_penetration);
  out.field("kinetic_energy", s.kinetic_energy).field("potential_energy", s.potential_energy);
  out.field("momentum", s.momentum).field("angular_momentum", s.angular_momentum).close('}');
}

void writeStep(JsonText& out, const Snapshot& s, const TraceOptions& options) {
  out.open('{').field("type", "step").field("step", s.step).field("t", s.time);
  out.array("bodies", s.bodies, [&](const BodyState& b) { writeBody(out, b); });
  out.array("contacts", s.contacts, [&](const ContactView& c) { writeContact(out, c); });
  out.array("collections", s.collections,
            [&](const CollectionView& c) { writeCollection(out, c); });
  if (!s.joints.empty()) {
    std::size_t id = 0;
    out.array("joints", s.joints, [&](const JointView& j) { writeJoint(out, id++, j); });
  }
  out.array("events", s.events, [&](const Event& e) { writeEvent(out, e); });
  if (options.decisions) {
    out.array("decisions", s.decisions, [&](const Decision& d) { writeDecision(out, d); });
    if (!s.groups.empty())
      out.array("groups", s.groups, [&](const Group& g) { writeGroup(out, g); });
  }
  writeStats(out, s.stats, options.timings);
  out.close('}');
}

}  // namespace

void writeEvent(JsonText& out, const Event& event, const Snapshot* when) {
  out.open('{');
  if (when != nullptr) out.field("step", when->step).field("t", when->time);
  out.field("type", name(event.type)).field("a", event.a).field("b", event.b);
  out.field("collection", event.collection);
  if (event.reason == EventReason::None) {
    out.field("reason", nullptr);
  } else {
    out.field("reason", name(event.reason));
  }
  out.close('}');
}

TraceWriter::TraceWriter(std::ostream& out, const Scene& scene, Mode mode,
                         const std::vector<BodyInfo>& bodies, const TraceOptions& options)
    : out_(out), options_(options) {
  writeHeader(line_, scene, mode, bodies);
  write();
}

void TraceWriter::add(const Snapshot& snapshot) {
  writeStep(line_, snapshot, options_);
  write();
}

void TraceWriter::write() {
  line_.endLine();
  out_.write(line_.text().data(), static_cast<std::streamsize>(line_.text().size()));
  line_.clear();
}

}  // namespace merge2d
