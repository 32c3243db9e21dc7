#!/usr/bin/env python3
"""Which room may include which. The order is what lets a room be read, tested and linked without
those above it, keeps a rigid scene free of deal.II, and the measures free of scenes.

    python3 tests/checks/layering.py      prints the violations
"""

from source_tree import cycles, includes, is_cpp, is_ours, main, room, unit, unit_graph

# Beside the rooms: the package that reads what the program writes. It includes nothing of ours.
READER = "apps/python"

# A room sees those before it.
APPS = [f"apps/{name}" for name in ("support", "scene", "model", "measures", "archive", "figures",
                                    "run", "laboratory", "studies", "commands")]
LIBRARIES = {"dem": {"dem"}, "fem": {"fem"}, "coupling": {"dem", "fem", "coupling"}}

# Units of the plug-in, which the program loads instead of linking: the only ones on deal.II and
# PETSc. What else is in fem is the interface, and free of them.
ELEMENTS = {f"fem/{name}" for name in ("mesh", "elasticity", "condensation", "solution", "material")}

# The other plug-in: discs over MPI. It sees dem, and nothing sees it.
RANKS = {f"dem/ranks/mpi/{name}" for name in ("mailboxes", "mpi_ranks", "require")}
RANKS_LIBRARIES = ("mpi.h", "petscsys.h")

# Headers that are neither ours nor of the C++ standard, whose names have no dot and no slash.
SYSTEM = ("dlfcn.h", "fcntl.h", "poll.h", "sched.h", "sys/", "unistd.h", "immintrin.h")
ELEMENT_LIBRARIES = ("deal.II/", "petsc")
FOREIGN = {
    "dem": ("immintrin.h", "sched.h", "sys/mman.h"),  # vectors, cores, large pages
    "fem": SYSTEM,
    "coupling": ("Eigen/",),
    "apps/measures": (),
    "apps": SYSTEM + ("fmt/", "nlohmann/", "toml++/", "CLI/", "hdf5.h", "Eigen/", "unsupported/Eigen/",
             "pugixml.hpp", "zlib.h", "csv.h"),
}


def rooms_seen_from(place):
    """Rooms of which a file in `place` may include headers."""
    if place in LIBRARIES:
        return LIBRARIES[place]
    if place == "apps/measures":  # they are of use to anyone with particle data
        return {"dem", "apps/support", place}
    below = APPS[:APPS.index(place) + 1] if place in APPS else APPS
    return set(LIBRARIES) | set(below)


def is_allowed(path, name):
    """Whether the file at `path` may include `name`."""
    if ".." in name or name.startswith("/"):  # could reach anything
        return False
    if is_ours(name):
        if any(unit(name) in plugin and unit(path) not in plugin for plugin in (ELEMENTS, RANKS)):
            return False
        return room(name) in rooms_seen_from(room(path))
    if name.islower() and "." not in name and "/" not in name:
        return True  # standard; a macro's name is in capitals
    if unit(path) in ELEMENTS and name.startswith(ELEMENT_LIBRARIES):
        return True
    if unit(path) in RANKS and name in RANKS_LIBRARIES:
        return True
    return name.startswith(FOREIGN.get(room(path), FOREIGN["apps"]))


def violations(tree):
    """Every forbidden include, file in no room and cycle of units of a tree, one line each."""
    found = []
    for path, text in tree.items():
        if room(path) == READER and not is_cpp(path):
            continue
        if path != "apps/main.cpp" and room(path) not in [*LIBRARIES, *APPS]:
            found.append(f"{path}: lies in no room")
        elif is_cpp(path):
            found += [f"{path}: must not include {name}"
                      for name in includes(text) if not is_allowed(path, name)]
    found += [f"cycle of units: {', '.join(cycle)}" for cycle in cycles(unit_graph(tree))]
    return found


if __name__ == "__main__":
    main(violations)
