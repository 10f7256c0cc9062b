"""Meshes that the tests of bad input make for themselves."""
import math
import struct


def stl(triangles):
    """ASCII STL; the reader makes its own normals."""
    text = "solid test\n"
    for corners in triangles:
        text += "facet normal 0 0 0\nouter loop\n"
        for x, y, z in corners:
            text += f"vertex {x:.9g} {y:.9g} {z:.9g}\n"
        text += "endloop\nendfacet\n"
    return text + "endsolid test\n"


def binary_stl(triangles, promised):
    """Binary STL whose header promises so many triangles."""
    data = b" " * 80 + struct.pack("<I", promised)
    for corners in triangles:
        data += struct.pack("<3f", 0, 0, 0)
        data += b"".join(struct.pack("<3f", *corner) for corner in corners)
        data += b"\0\0"
    return data


def scaled(triangles, factor):
    return [tuple(tuple(factor * x for x in corner) for corner in corners)
            for corners in triangles]


def box_triangles(n_missing=0):
    """Twelve triangles of a cube, less the last ones."""
    p = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3),
             (0, 4, 6, 2), (1, 3, 7, 5)]
    triangles = []
    for a, b, c, d in quads:
        triangles += [(p[a], p[b], p[c]), (p[a], p[c], p[d])]
    return triangles[:len(triangles) - n_missing]


def torus_triangles():
    """Closed, but its centroid is outside: not star-shaped."""
    def at(i, j):
        u, v = 2 * math.pi * (i % 24) / 24, 2 * math.pi * (j % 12) / 12
        r = 2 + 0.7 * math.cos(v)
        return (r * math.cos(u), r * math.sin(u), 0.7 * math.sin(v))
    triangles = []
    for i in range(24):
        for j in range(12):
            a, b = at(i, j), at(i + 1, j)
            c, d = at(i + 1, j + 1), at(i, j + 1)
            triangles += [(a, b, c), (a, c, d)]
    return triangles


def mushroom_triangles():
    """A closed body of revolution whose cap hangs over its stem: the centroid
    is inside, yet rays to the rim meet the surface three times."""
    profile = [(0., 0.), (0.5, 0.), (0.5, 2.), (1.9, 0.6), (2.1, 0.8),
               (1.2, 2.4), (0., 2.8)]
    def at(k, i):
        r, z = profile[k]
        u = 2 * math.pi * (i % 32) / 32
        return (r * math.cos(u), r * math.sin(u), z)
    triangles = []
    for k in range(len(profile) - 1):
        for i in range(32):
            a, b = at(k, i), at(k, i + 1)
            c, d = at(k + 1, i + 1), at(k + 1, i)
            if profile[k][0] > 0.:
                triangles.append((a, b, c))
            if profile[k + 1][0] > 0.:
                triangles.append((a, c, d))
    return triangles


def gmsh(nodes, cells, volume=lambda k: 1):
    """A .msh file (format 2) of hexahedra with their physical volumes; corners
    of a cell: four round a face, then those opposite."""
    text = f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(nodes)}\n"
    for k, (x, y, z) in enumerate(nodes, 1):
        text += f"{k} {x!r} {y!r} {z!r}\n"
    text += f"$EndNodes\n$Elements\n{len(cells)}\n"
    for k, cell in enumerate(cells):
        corners = " ".join(str(node + 1) for node in cell)
        text += f"{k + 1} 5 2 {volume(k)} 1 {corners}\n"
    return text + "$EndElements\n"


def block(x, y, z, position=lambda *at: at):
    """Nodes and cells of a block with its mesh lines at these x, y and z, each
    node moved to its position."""
    def number(i, j, k):
        return i + len(x) * (j + len(y) * k)
    nodes = [position(a, b, c) for c in z for b in y for a in x]
    # Turned so that Spall numbers the nodes as those of its own block.
    corners = ((0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1),
               (0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1))
    cells = [[number(i + di, j + dj, k + dk) for di, dj, dk in corners]
             for k in range(len(z) - 1) for j in range(len(y) - 1)
             for i in range(len(x) - 1)]
    return nodes, cells


def second_order_quad():
    """A .msh file (format 2) of one quad of eight nodes."""
    corners = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n"
    for k, (x, y) in enumerate(corners, 1):
        text += f"{k} {x} {y} 0\n"
    return text + "$EndNodes\n$Elements\n1\n1 16 2 1 1 " \
        "1 2 3 4 5 6 7 8\n$EndElements\n"


def extruded(quads, points, z):
    """Nodes and cells of a plane mesh of quads, carried along heights z."""
    n = len(points)
    nodes = [(x, y, c) for c in z for x, y in points]
    cells = [[node + n * (k + above) for above in (0, 1) for node in quad]
             for k in range(len(z) - 1) for quad in quads]
    return nodes, cells


def box_sheet(across, heights):
    """A .msh file with the quads of the four sides of an upright box with its
    mesh lines at these positions along x and y, and at these heights."""
    low, high = across[0], across[-1]
    ring = [(x, low) for x in across[:-1]] + [(high, y) for y in across[:-1]]
    ring += [(x, high) for x in across[:0:-1]] + \
        [(low, y) for y in across[:0:-1]]
    n = len(ring)
    nodes = [(x, y, z) for z in heights for x, y in ring]
    text = f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(nodes)}\n"
    for k, (x, y, z) in enumerate(nodes, 1):
        text += f"{k} {x!r} {y!r} {z!r}\n"
    quads = [(k * n + i, k * n + (i + 1) % n, (k + 1) * n + (i + 1) % n,
              (k + 1) * n + i) for k in range(len(heights) - 1)
             for i in range(n)]
    text += f"$EndNodes\n$Elements\n{len(quads)}\n"
    for k, quad in enumerate(quads, 1):
        text += f"{k} 3 2 1 1 {' '.join(str(node + 1) for node in quad)}\n"
    return text + "$EndElements\n"
