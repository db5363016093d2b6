#include "render/shaders.h"

namespace merge2d::shaders {

// Row 0 of the framebuffer is the top row of the picture, so y goes down without a flip.
#define MERGE2D_TO_CLIP                                             \
  "uniform vec2 picture;\n"                                         \
  "vec4 toClip(vec2 pixel) {\n"                                     \
  "  return vec4(pixel / picture * 2.0 - 1.0, 0.0, 1.0);\n"         \
  "}\n"                                                             \
  "vec2 corner() {  // of a triangle strip, in [-1, 1]\n"           \
  "  return vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;\n" \
  "}\n"

// How much of a pixel lies inside of an edge at the signed distance d [px].
#define MERGE2D_COVERAGE "float coverage(float d) { return clamp(0.5 - d, 0.0, 1.0); }\n"

const Source kShape = {"#version 330 core\n" MERGE2D_TO_CLIP R"(
layout(location = 0) in vec4 place;   // centre, x axis
layout(location = 1) in vec4 size;    // half extents, radius, line
layout(location = 2) in vec4 stripes; // per pixel in x and y, phase, width
layout(location = 3) in ivec2 edges;  // first, count
layout(location = 4) in vec4 fill;
layout(location = 5) in vec4 outline;
layout(location = 6) in vec4 hatch;
out vec2 local;
out float stripe;
flat out vec4 v_size;
flat out vec2 v_stripes;              // width, pixels per stripe
flat out ivec2 v_edges;
flat out vec4 v_fill, v_outline, v_hatch;

void main() {
  local = corner() * (size.xy + size.z + 1.0);
  vec2 pixel = place.xy + local.x * place.zw + local.y * vec2(-place.w, place.z);
  float density = length(stripes.xy);
  stripe = dot(pixel, stripes.xy) + stripes.z;
  v_size = size;
  v_stripes = vec2(stripes.w, density > 0.0 ? 1.0 / density : 0.0);
  v_edges = edges;
  v_fill = vec4(fill.rgb, 1.0) * fill.a;
  v_outline = vec4(outline.rgb, 1.0) * outline.a;
  v_hatch = vec4(hatch.rgb, 1.0) * hatch.a;
  gl_Position = toClip(pixel);
}
)",
                       "#version 330 core\n" MERGE2D_COVERAGE R"(
uniform samplerBuffer polygons;       // vertex, edge vector
in vec2 local;
in float stripe;
flat in vec4 v_size;
flat in vec2 v_stripes;
flat in ivec2 v_edges;
flat in vec4 v_fill, v_outline, v_hatch;
out vec4 color;

float boxDistance(vec2 p, vec2 h) {
  vec2 q = abs(p) - h;
  return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0);
}

// Inside, the nearest edge line; outside, the nearest point of the outline.
float polygonDistance(vec2 p, ivec2 range) {
  float inside = -1e9, outside = 1e18;
  for (int i = 0; i < range.y; ++i) {
    vec4 edge = texelFetch(polygons, range.x + i);
    vec2 w = p - edge.xy;
    vec2 nearest = w - edge.zw * clamp(dot(w, edge.zw) / dot(edge.zw, edge.zw), 0.0, 1.0);
    outside = min(outside, dot(nearest, nearest));
    inside = max(inside, (w.x * edge.w - w.y * edge.z) * inversesqrt(dot(edge.zw, edge.zw)));
  }
  return inside > 0.0 ? sqrt(outside) : inside;
}

void main() {
  float d = boxDistance(local, v_size.xy);
  if (v_edges.y > 0) d = polygonDistance(local, v_edges);
  d -= v_size.z;
  float outer = coverage(d), inner = coverage(d + v_size.w);
  float stripe_distance = abs(fract(stripe) - 0.5) * v_stripes.y - 0.5 * v_stripes.x;
  float striped = v_stripes.y > 0.0 ? coverage(stripe_distance) : 0.0;
  vec4 fill = v_fill + (v_hatch - v_fill * v_hatch.a) * striped;
  color = v_outline * (outer - inner) + fill * inner;
}
)"};

const Source kArrow = {"#version 330 core\n" MERGE2D_TO_CLIP R"(
layout(location = 0) in vec4 ends;    // tail, tip
layout(location = 1) in vec3 size;    // shaft width, head, rim
layout(location = 2) in vec4 fill;
layout(location = 3) in vec4 rim;
out vec2 local;                       // along the arrow from its tail, and across
flat out vec4 v_size;                 // width, head, rim, length
flat out vec4 v_fill, v_rim;

void main() {
  vec2 along = ends.zw - ends.xy;
  float length_ = max(length(along), 1e-3);
  vec2 axis = along / length_;
  float grow = size.z + 1.0;
  float half_width = 0.5 * max(size.x, size.y) + grow;
  vec2 c = corner();
  local = vec2(0.5 * length_ + c.x * (0.5 * length_ + grow), c.y * half_width);
  v_size = vec4(size, length_);
  v_fill = vec4(fill.rgb, 1.0) * fill.a;
  v_rim = vec4(rim.rgb, 1.0) * rim.a;
  gl_Position = toClip(ends.xy + local.x * axis + local.y * vec2(-axis.y, axis.x));
}
)",
                       "#version 330 core\n" MERGE2D_COVERAGE R"(
in vec2 local;
flat in vec4 v_size;
flat in vec4 v_fill, v_rim;
out vec4 color;

void main() {
  vec2 p = vec2(local.x, abs(local.y));
  float neck = v_size.w - v_size.y;
  // The shaft ends inside of the head.
  float shaft = max(max(-p.x, p.x - neck - 1.0), p.y - 0.5 * v_size.x);
  // The head is a triangle as wide as it is long: its sides have the slope 1/2.
  float head = max(neck - p.x, (p.y - 0.5 * (v_size.w - p.x)) * 0.894427);
  float d = min(shaft, head);
  float inner = coverage(d), outer = coverage(d - v_size.z);
  color = v_fill * inner + v_rim * (outer - inner);
}
)"};

const Source kGlyph = {"#version 330 core\n" MERGE2D_TO_CLIP R"(
layout(location = 0) in vec4 box;     // left, top, width, height
layout(location = 1) in vec2 source;  // left, top in the atlas
layout(location = 2) in vec4 fill;
out vec2 texel;
flat out vec4 v_fill;

void main() {
  vec2 offset = (corner() * 0.5 + 0.5) * box.zw;
  texel = source + offset;
  v_fill = vec4(fill.rgb, 1.0) * fill.a;
  gl_Position = toClip(box.xy + offset);
}
)",
                       R"(#version 330 core
uniform sampler2D atlas;
in vec2 texel;
flat in vec4 v_fill;
out vec4 color;

void main() { color = v_fill * texelFetch(atlas, ivec2(texel), 0).r; }
)"};

}  // namespace merge2d::shaders
