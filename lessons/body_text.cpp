#include "lessons/body_text.h"

#include "render/silhouette.h"

namespace merge2d {

void writeBody(JsonText& out, const BodyInfo& body) {
  out.open('{').field("name", body.name).field("motion", name(body.motion));
  out.field("mass", body.mass).field("inertia", body.inertia);
  const Silhouette looks = silhouette(body.shapes);
  out.array("pieces", looks.pieces, [&](const Piece& piece) {
    out.open('[');
    if (piece.kind == Piece::Kind::Disc) {
      out.value(piece.frame.position.x()).value(piece.frame.position.y()).value(piece.radius);
    } else {
      for (const Vec2& v : piece.vertices) out.value(v);
    }
    out.close(']');
  });
  out.array("boundary", looks.boundary,
            [&](const Segment& s) { out.row(s.from.x(), s.from.y(), s.to.x(), s.to.y()); });
  out.close('}');
}

}  // namespace merge2d
