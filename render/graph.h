#pragma once
/// Contact graphs as pictures.

#include "render/canvas.h"
#include "render/theme.h"
#include "src2d/cycles/contact_graph.h"

namespace merge2d {

/// Draws the graph twice: with the groups of the triangle criterion and with the rigid ones. What
/// holds single contacts together is shaded: cycles of three, or all that are linked. Bodies are
/// discs, or, where all contact points are known, links between them. One line is one contact, a
/// double line two or more; red contacts do not hold.
Drawing composeGraph(Text& text, const ContactGraph& graph, const CycleVerdicts& verdicts,
                     int width, int height, const Theme& theme = lightTheme());
Picture drawGraph(Canvas& canvas, const ContactGraph& graph, const CycleVerdicts& verdicts,
                  const Theme& theme = lightTheme());

}  // namespace merge2d
