"""A renderer of one's own: bodies and collections as an SVG picture, from the world's arrays."""

import math

import merge2d

COLORS = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377")
SCALE = 60  # pixels per metre

world = merge2d.World("books")
world.step(150)


def element(body):
    """The pieces of a body, at its pose, in the colour of its collection."""
    x, y = world.positions[body]
    if math.isnan(x):
        return ""
    collection = world.collection_ids[body]
    color = "#dddddd" if collection < 0 else COLORS[collection % len(COLORS)]
    turn = math.degrees(world.angles[body])
    out = f'<g transform="translate({x} {y}) rotate({turn})" fill="{color}">'
    for piece in world.pieces(body):
        if isinstance(piece, tuple):
            out += f'<circle cx="{piece[0]}" cy="{piece[1]}" r="{piece[2]}"/>'
        else:
            corners = " ".join(f"{px},{py}" for px, py in piece)
            out += f'<polygon points="{corners}"/>'
    return out + "</g>"


with open("books.svg", "w", encoding="utf-8") as file:
    file.write('<svg xmlns="http://www.w3.org/2000/svg" width="720" height="400">'
               f'<g transform="translate(360 320) scale({SCALE} {-SCALE})" stroke="#333" '
               'stroke-width="0.02">')
    file.write("".join(element(body) for body in range(len(world))))
    file.write("</g></svg>\n")
print(f"books.svg shows {len(world)} bodies in {world.counts['collections']} collections")
