#pragma once
/// The named graphs of docs/cycles.md, as text, and what they should give. Points are world
/// coordinates in metres.

#include <string>
#include <vector>

namespace merge2d {

struct NamedGraph {
  std::string name, text;
  std::string triangle, rigid;  ///< groups, "A B, C D"
};

inline const std::vector<NamedGraph>& namedGraphs() {
  static const std::vector<NamedGraph> graphs = {
      {"nothing", "", "", ""},
      {"pair-one-contact", "A B 1\n", "", ""},
      {"pair-two-contacts", "A B 2\n", "A B", "A B"},
      {"pair-no-contact", "A B 0\n", "", ""},
      {"triangle", "A B 1\nB C 1\nC A 1\n", "A B C", "A B C"},
      {"triangle-placed", "A B 1 0,0\nB C 1 1,0\nC A 1 0.5,1\n", "A B C", "A B C"},
      {"triangle-collinear", "A B 1 0,0\nB C 1 1,0\nC A 1 2,0\n", "A B C", ""},
      {"triangle-coincident", "A B 1 1,2\nB C 1 1,2\nC A 1 1,2\n", "A B C", ""},
      {"ring-of-four", "A B 1\nB C 1\nC D 1\nD A 1\n", "", ""},
      {"ring-of-four-placed", "A B 1 0,0\nB C 1 2,0\nC D 1 3,2\nD A 1 0,1\n", "", ""},
      {"ring-of-four-diagonal", "A B 1\nB C 1\nC D 1\nD A 1\nA C 1\n", "A B C D", "A B C D"},
      {"ring-of-four-doubled", "A B 2\nB C 1\nC D 1\nD A 1\n", "A B C D", "A B C D"},
      {"two-triangles-sharing-a-pair", "A B 1\nB C 1\nC A 1\nB D 1\nC D 1\n", "A B C D", "A B C D"},
      {"two-triangles-sharing-a-body", "A B 1\nB C 1\nC A 1\nC D 1\nD E 1\nE C 1\n", "A B C D E",
       "A B C D E"},
      {"ring-of-five-two-doubled", "A B 2\nB C 1\nC D 2\nD E 1\nE A 1\n", "A B C D E", "A B C D E"},
      {"ring-of-five-one-doubled", "A B 2\nB C 1\nC D 1\nD E 1\nE A 1\n", "A B", "A B"},
      {"between-two-pinned", "pinned P Q\nP A 1\nA Q 1\n", "A P Q", "A P Q"},
      {"between-two-pinned-one-point", "pinned P Q\nP A 1 1,1\nA Q 1 1,1\n", "A P Q", "P Q"},
      {"two-between-two-pinned", "pinned P Q\nP A 1\nA B 1\nB Q 1\n", "A B P Q", "A B P Q"},
      {"three-between-two-pinned", "pinned P Q\nP A 1\nA B 1\nB C 1\nC Q 1\n", "P Q", "P Q"},
      {"on-two-of-one-group", "A B 2\nA D 1\nB D 1\n", "A B D", "A B D"},
      {"tree", "A B 1\nA C 1\nB D 1\nB E 1\nC F 1\n", "", ""},
      {"chain", "A B 1\nB C 1\nC D 1\nD E 1\n", "", ""},
      {"chain-firm", "A B 2\nB C 3\nC D 2\n", "A B C D", "A B C D"},
      // Three links, each with a contact on either of the two bodies.
      {"three-links", "A L 1\nL B 1\nA M 1\nM B 1\nA N 1\nN B 1\n", "", "A B L M N"},
      {"three-links-askew",
       "A L 1 0,0\nL B 1 0,1\nA M 1 1,0\nM B 1 1.2,1\nA N 1 2,0\nN B 1 1.9,1\n", "", "A B L M N"},
      {"three-links-parallel",
       "A L 1 0,0\nL B 1 0,1\nA M 1 1,0\nM B 1 1,1\nA N 1 2,0\nN B 1 2,1.5\n", "", ""},
      {"three-links-through-one-point",
       "A L 1 0,1\nL B 1 0,2\nA M 1 1,0\nM B 1 2,0\nA N 1 1,1\nN B 1 2,2\n", "", ""},
      {"coincident-points", "A B 2 3,1 3,1\n", "A B", ""},
      {"three-points-two-coincident", "A B 3 3,1 3,1 3,2\n", "A B", "A B"},
      {"nearly-coincident-points", "A B 2 1,1 1.000000001,1\n", "A B", ""},
      {"triangles-in-a-chain", "A B 1\nB C 1\nC A 1\nC D 1\nB D 1\nD E 1\nC E 1\nE F 1\nD F 1\n",
       "A B C D E F", "A B C D E F"},
      // Two triangles of bodies, three links between them: the prism; rigid by its last contact.
      {"prism",
       "A B 1\nB C 1\nC A 1\nD E 1\nE F 1\nF D 1\nA L 1\nL D 1\nB M 1\nM E 1\nC N 1\nN F 1\n",
       "A B C, D E F", "A B C D E F L M N"},
      {"prism-without-its-last",
       "A B 1\nB C 1\nC A 1\nD E 1\nE F 1\nF D 1\nA L 1\nL D 1\nB M 1\nM E 1\nC N 1\n",
       "A B C, D E F", "A B C, D E F"},
      {"triangle-of-groups", "A B 2\nC D 2\nE F 2\nB C 1\nD E 1\nF A 1\n", "A B C D E F",
       "A B C D E F"},
      // Every two of three bodies of one side touch every one of the other side.
      {"three-on-three", "A D 1\nA E 1\nA F 1\nB D 1\nB E 1\nB F 1\nC D 1\nC E 1\nC F 1\n", "",
       "A B C D E F"},
      {"cube",
       "A B 1\nB C 1\nC D 1\nD A 1\nE F 1\nF G 1\nG H 1\nH E 1\nA E 1\nB F 1\nC G 1\nD H 1\n", "",
       "A B C D E F G H"},
      {"ring-of-seven", "A B 1\nB C 1\nC D 1\nD E 1\nE F 1\nF G 1\nG A 1\n", "", ""},
      // A free link does not hold A and B, though the two of them cannot move without it.
      {"held-by-others", "A L 1 0,0\nL B 1 0,0\nA M 1 1,0\nM B 1 1,0\nA N 1 2,1\nN B 1 2,1\n", "",
       ""},
      // A degenerate triangle beside a good one: what is rigid of it remains.
      {"degenerate-part", "A B 1 0,0\nB C 1 1,0\nC A 1 0,1\nC D 1 5,5\nD E 1 6,6\nE C 1 7,7\n",
       "A B C D E", "A B C"},
      // The same triangle of bodies, held by a fourth contact that is not on the line.
      {"collinear-but-doubled", "A B 2 0,0 0,1\nB C 1 1,0\nC A 1 2,0\n", "A B C", "A B C"},
      {"four-all-touching", "A B 1\nA C 1\nA D 1\nB C 1\nB D 1\nC D 1\n", "A B C D", "A B C D"},
      // 14 doubled edges would do for five bodies, were not twelve of them between four.
      {"four-all-touching-and-a-fifth", "A B 1\nA C 1\nA D 1\nB C 1\nB D 1\nC D 1\nA E 1\n",
       "A B C D", "A B C D"},
      // Rings of four that share two bodies which do not touch: three of them hold these.
      {"two-rings-sharing-opposite-bodies",
       "H P 1\nP K 1\nH Q 1\nQ K 1\nH R 1\nR K 1\nH S 1\nS K 1\n", "", "H K P Q R S"},
      {"rings-of-four-in-a-chain", "A B 1\nB C 1\nC D 1\nD A 1\nC E 1\nE F 1\nF G 1\nG C 1\n", "",
       ""},
      {"wheel",
       "H A 1\nH B 1\nH C 1\nH D 1\nH E 1\nH F 1\nA B 1\nB C 1\nC D 1\nD E 1\nE F 1\nF A 1\n",
       "A B C D E F H", "A B C D E F H"},
      {"pinned-groups", "pinned P Q\nP A 2\nQ B 2\nA B 1\nA C 1\nC B 1\nB D 1\n", "A B C P Q",
       "A B C P Q"},
      {"ring-of-four-two-pinned-across", "pinned A C\nA B 1\nB C 1\nC D 1\nD A 1\n", "A B C D",
       "A B C D"},
      {"ring-of-five-one-pinned", "pinned A\nA B 1\nB C 1\nC D 1\nD E 1\nE A 1\n", "", ""},
      {"rigid-only-through-what-is-pinned", "pinned P Q\nP A 1\nA B 1\nB Q 1\nC D 1\nD E 1\n",
       "A B P Q", "A B P Q"},
      // Two firm groups, A with B and C with D.
      {"groups-by-two-contacts", "A B 2 0,0 1,0\nC D 2 0,5 1,5\nA C 1 0,2\nB D 1 4,2\n", "A B C D",
       "A B C D"},
      {"groups-by-two-contacts-in-one-spot", "A B 2 0,0 1,0\nC D 2 0,5 1,5\nA C 1 2,2\nB D 1 2,2\n",
       "A B C D", "A B, C D"},
      {"groups-by-links-askew",
       "A B 2 0,0 1,0\nC D 2 0,5 1,5\nA L 1 0,1\nL C 1 0,4\nB M 1 1,1\nM D 1 1.5,4\nA N 1 2,1\n"
       "N C 1 2,4\n",
       "A B, C D", "A B C D L M N"},
      {"groups-by-links-parallel",
       "A B 2 0,0 1,0\nC D 2 0,5 1,5\nA L 1 0,1\nL C 1 0,4\nB M 1 1,1\nM D 1 1,4\nA N 1 2,1\n"
       "N C 1 2,4\n",
       "A B, C D", "A B, C D"},
      {"groups-by-links-through-one-point",
       "A B 2 0,0 1,0\nC D 2 0,5 1,5\nA L 1 -1,1\nL C 1 -2,2\nB M 1 0,1\nM D 1 0,2\nA N 1 1,1\n"
       "N C 1 2,2\n",
       "A B, C D", "A B, C D"},
  };
  return graphs;
}

}  // namespace merge2d
