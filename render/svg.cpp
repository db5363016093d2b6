#include "render/svg.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "render/outline_path.h"
#include "src2d/core/utf8.h"

namespace merge2d {
namespace {

std::string xmlText(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:  // XML has no characters below the space but line breaks
        out += static_cast<unsigned char>(c) < 0x20 && c != '\n' ? ' ' : c;
    }
  }
  return out;
}

/// ` fill="#rrggbb"`, with an opacity where it is not opaque.
std::string paintAttribute(const char* name, Color color) {
  std::string out = fmt::format(" {}=\"#{:02x}{:02x}{:02x}\"", name, color.r, color.g, color.b);
  if (color.a != 255) {
    out += fmt::format(" {}-opacity=\"{}\"", name, shortNumber(static_cast<float>(color.a) / 255));
  }
  return out;
}

/// Writes one drawing.
class SvgWriter {
 public:
  SvgWriter(const Drawing& drawing, const SvgOptions& options)
      : drawing_(drawing), options_(options) {}

  std::string write() {
    for (const Layer& layer : drawing_.layers) writeLayer(layer);
    std::string out;
    if (!options_.inner) out += kSvgStart;
    out += fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\" role=\"img\" "
        "font-family=\"'DejaVu Sans',Verdana,sans-serif\">\n",
        options_.width, options_.height);
    if (!options_.title.empty()) out += "<title>" + xmlText(escaped(options_.title)) + "</title>\n";
    if (!options_.description.empty())
      out += "<desc>" + xmlText(escaped(options_.description, "\n")) + "</desc>\n";
    if (!definitions_.empty()) out += "<defs>\n" + definitions_ + "</defs>\n";
    if (drawing_.background.a > 0) {
      out += fmt::format("<rect width=\"{}\" height=\"{}\"{}/>\n", options_.width, options_.height,
                         paintAttribute("fill", drawing_.background));
    }
    return out + body_ + "</svg>\n";
  }

 private:
  void writeLayer(const Layer& layer) {
    if (layer.clip) {
      body_ += fmt::format("<g clip-path=\"url(#{})\">\n", clipId(*layer.clip));
    } else {
      body_ += "<g>\n";
    }
    for (const ShapeInstance& shape : layer.shapes) writeShape(shape);
    for (const ArrowInstance& arrow : layer.arrows) writeArrow(arrow);
    for (const TextLine& line : layer.lines) writeLine(line);
    body_ += "</g>\n";
  }

  void writeShape(const ShapeInstance& shape) {
    const std::vector<Pixel> core = coreOf(shape, drawing_.edges);
    const bool outlined = shape.line > 0.0F && shape.outline.a > 0;
    if (!outlined && shape.hatch_color.a == 0 && writePlain(shape, core)) return;
    const std::string outer = outlinePath(core, shape.radius);
    const std::string inner =
        shape.line > 0.0F ? outlinePath(core, shape.radius - shape.line) : outer;
    if (outlined && shape.fill.a == 255) {
      writePath(outer, paintAttribute("fill", shape.outline));  // no seam shows beneath the fill
    } else if (outlined) {
      writePath(outer + inner, paintAttribute("fill", shape.outline) + " fill-rule=\"evenodd\"");
    }
    if (shape.fill.a > 0) writePath(inner, paintAttribute("fill", shape.fill));
    const bool hatched = shape.hatch.x != 0.0F || shape.hatch.y != 0.0F;
    if (hatched && shape.hatch_color.a > 0) {
      writePath(inner, fmt::format(" fill=\"url(#{})\"", hatchId(shape)));
    }
  }

  /// Discs, lines and upright boxes without an outline have elements of their own.
  bool writePlain(const ShapeInstance& shape, const std::vector<Pixel>& core) {
    if (shape.fill.a == 0) return true;
    const std::string fill = paintAttribute("fill", shape.fill);
    if (shape.line > 0.0F || shape.edge_count > 0) return false;
    if (core.size() == 1) {
      body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n", shortNumber(core[0].x),
                           shortNumber(core[0].y), shortNumber(shape.radius), fill);
      return true;
    }
    if (core.size() == 2) {
      if (shape.radius <= 0.0F) return true;
      body_ += fmt::format(
          "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"{} stroke-width=\"{}\" "
          "stroke-linecap=\"round\"/>\n",
          shortNumber(core[0].x), shortNumber(core[0].y), shortNumber(core[1].x),
          shortNumber(core[1].y), paintAttribute("stroke", shape.fill),
          shortNumber(2.0F * shape.radius));
      return true;
    }
    if (shape.axis.y != 0.0F || shape.radius > 0.0F) return false;
    body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>\n",
                         shortNumber(core[0].x), shortNumber(core[0].y),
                         shortNumber(2.0F * shape.half.x), shortNumber(2.0F * shape.half.y), fill);
    return true;
  }

  void writePath(const std::string& data, const std::string& paint) {
    if (!data.empty()) body_ += fmt::format("<path d=\"{}\"{}/>\n", data, paint);
  }

  /// A shaft inside of a head that is as wide as it is long; the rim goes around both.
  void writeArrow(const ArrowInstance& arrow) {
    const Pixel along = arrow.tip - arrow.tail;
    const float length = std::hypot(along.x, along.y);
    if (length <= 0.0F) return;
    const Pixel u = along * (1.0F / length), v{-u.y, u.x};
    const float neck = length - arrow.head, shaft = 0.5F * arrow.width, head = 0.5F * arrow.head;
    const std::array<Pixel, 7> corners = {Pixel{0.0F, shaft}, {neck, shaft}, {neck, head},
                                          {length, 0.0F},     {neck, -head}, {neck, -shaft},
                                          {0.0F, -shaft}};
    std::string data;
    for (const Pixel c : corners) {
      const Pixel p = arrow.tail + u * c.x + v * c.y;
      data += fmt::format("{}{} {}", data.empty() ? "M" : "L", shortNumber(p.x), shortNumber(p.y));
    }
    data += "Z";
    if (arrow.rim > 0.0F && arrow.rim_color.a > 0) {
      writePath(data, paintAttribute("fill", arrow.rim_color) +
                          paintAttribute("stroke", arrow.rim_color) +
                          fmt::format(" stroke-width=\"{}\" stroke-linejoin=\"round\"",
                                      shortNumber(2.0F * arrow.rim)));
    }
    writePath(data, paintAttribute("fill", arrow.color));
  }

  void writeLine(const TextLine& line) {
    if (line.text.empty()) return;
    body_ += fmt::format(
        "<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}{} textLength=\"{}\" "
        "lengthAdjust=\"spacingAndGlyphs\" xml:space=\"preserve\">{}</text>\n",
        shortNumber(line.start.x), shortNumber(line.start.y), line.size,
        line.bold ? " font-weight=\"bold\"" : "", paintAttribute("fill", line.color),
        shortNumber(line.width), xmlText(escaped(line.text)));
  }

  std::string clipId(const PixelBox& box) {
    return define("clip", fmt::format("<clipPath id=\"@\"><rect x=\"{}\" y=\"{}\" width=\"{}\" "
                                      "height=\"{}\"/></clipPath>\n",
                                      shortNumber(box.x), shortNumber(box.y),
                                      shortNumber(box.width), shortNumber(box.height)));
  }

  /// Stripes that are fixed to the picture, as the shader has them: centred where the phase is ½.
  std::string hatchId(const ShapeInstance& shape) {
    const float density = std::hypot(shape.hatch.x, shape.hatch.y), period = 1.0F / density;
    const double degrees = std::atan2(shape.hatch.y, shape.hatch.x) * 180.0 / std::numbers::pi;
    const float start = (0.5F - shape.hatch_phase) * period - 0.5F * shape.hatch_width;
    return define(
        "hatch",
        fmt::format("<pattern id=\"@\" patternUnits=\"userSpaceOnUse\" width=\"{0}\" "
                    "height=\"{0}\" patternTransform=\"rotate({1}) translate({2} 0)\">"
                    "<rect width=\"{3}\" height=\"{0}\"{4}/></pattern>\n",
                    period, shortNumber(static_cast<float>(degrees)), shortNumber(start),
                    shortNumber(shape.hatch_width), paintAttribute("fill", shape.hatch_color)));
  }

  /// The id of a definition, in which it stands as "@"; the same one has one id.
  std::string define(const char* kind, const std::string& definition) {
    const auto [found, is_new] = ids_.emplace(definition, "");
    if (!is_new) return found->second;
    found->second = fmt::format("{}-{}{}", options_.id_prefix, kind, ids_.size());
    std::string text = definition;
    definitions_ += text.replace(text.find('@'), 1, found->second);
    return found->second;
  }

  const Drawing& drawing_;
  const SvgOptions& options_;
  std::map<std::string, std::string> ids_;
  std::string definitions_, body_;
};

}  // namespace

std::string toSvg(const Drawing& drawing, const SvgOptions& options) {
  return SvgWriter(drawing, options).write();
}

}  // namespace merge2d
