#!/usr/bin/env python3
"""Which room may include which. The order is what lets a room be read, tested and linked without
those above it, keeps a rigid scene free of deal.II, and the measures free of scenes.

    python3 tests/checks/layering.py      prints the violations
"""

import re
from pathlib import PurePosixPath

from source_tree import cycles, includes, is_cpp, is_ours, main, room, unit, unit_graph

# Beside the rooms: the package that reads what the program writes. It includes nothing of ours.
READER = "apps/python"

# A room sees those before it.
APPS = [f"apps/{name}" for name in ("support", "scene", "model", "measures", "archive", "figures",
                                    "run", "laboratory", "studies", "commands", "page")]
LIBRARIES = {"dem": {"dem"}, "fem": {"fem"}, "coupling": {"dem", "fem", "coupling"},
             "fluid": {"dem", "fluid"}, "thermal": {"dem", "fluid", "thermal"}}

# Units of the plug-in, which the program loads instead of linking: the only ones on deal.II and
# PETSc. What else is in fem is the interface, and free of them.
ELEMENTS = {f"fem/{name}" for name in ("mesh", "elasticity", "condensation", "solution", "material")}

# The other plug-in: discs over MPI. It sees dem, and nothing sees it.
RANKS = {f"dem/ranks/mpi/{name}" for name in ("mpi_ranks", "require")}
RANKS_LIBRARIES = ("mpi.h", "petscsys.h")

# Floors of dem, from the ground: a file sees those before its own. The nouns lie in dem itself, and
# so does the roof, which drives all of it.
FLOORS_OF_DEM = ("dem/numbers", "dem/threads", "dem", "dem/base", "dem/contacts", "dem/cycle", "dem/genesis",
                 "dem/events", "dem/ranks", "dem/ranks/mpi", "roof of dem")
ROOF_OF_DEM = {"dem/simulation", "dem/model"}
# The cycle as it is specified, which is written to be read: alone in the world, on one page or two.
SPECIFICATION = {"dem/cycle/plain_cycle.hpp", "dem/cycle/plain_cycle.cpp"}
MOST_LINES = 250
WORDS_OF_RANKS = {"rank", "ranks", "ranked", "ghost", "ghosts", "halo", "subdomain", "subdomains", "mpi"}

# Headers that are neither ours nor of the C++ standard, whose names have no dot and no slash.
SYSTEM = ("dlfcn.h", "fcntl.h", "poll.h", "sched.h", "sys/", "unistd.h", "immintrin.h")
ELEMENT_LIBRARIES = ("deal.II/", "petsc")
FOREIGN = {
    "dem": ("immintrin.h", "sched.h", "sys/mman.h"),  # vectors, cores, large pages
    "fem": SYSTEM,
    "coupling": ("Eigen/",),
    "fluid": ("Eigen/",),
    "thermal": (),
    "apps/measures": (),
    "apps": SYSTEM + ("fmt/", "nlohmann/", "toml++/", "CLI/", "hdf5.h", "Eigen/", "unsupported/Eigen/",
             "pugixml.hpp", "zlib.h"),
}

# Headers that take a second or more to compile, each with the headers that may include it. A source includes what it
# uses; a header hands it to all who include the header.
HEAVY = {
    "toml++/": {"apps/scene/toml/toml.hpp"},
    "apps/scene/toml/toml.hpp": {"apps/scene/toml/document.hpp", "apps/scene/toml/json_document.hpp",
                                 "apps/scene/scene_checks.hpp",
                                 "apps/studies/plan_file.hpp"},
    # These hold a value of JSON; others do with nlohmann/json_fwd.hpp.
    "nlohmann/json.hpp": {"apps/figures/picture_order.hpp", "apps/laboratory/report.hpp", "apps/studies/plan_file.hpp",
                          "apps/laboratory/calibration/calibration_fit.hpp"},
    "Eigen/": {f"apps/scene/svg/svg_{name}.hpp" for name in ("path", "place", "transform")},
    "unsupported/Eigen/": set(),
    "CLI/": {f"apps/commands/{name}.hpp" for name in ("command", "underlay", "asked_accuracy", "help/help")},
    "regex": set(),
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


def floor_of_dem(path):
    """The floor of dem that a file lies on."""
    return "roof of dem" if unit(path) in ROOF_OF_DEM else str(PurePosixPath(path).parent)


def violations_in_dem(tree):
    """Includes of dem that go up, files that lie on none of its floors, and what is wrong with the specification."""
    found = []
    for path, text in tree.items():
        if room(path) != "dem" or not is_cpp(path):
            continue
        floor = floor_of_dem(path)
        if floor not in FLOORS_OF_DEM:
            found.append(f"{path}: lies on no floor of dem")
            continue
        below = FLOORS_OF_DEM[:FLOORS_OF_DEM.index(floor) + 1]
        found += [f"{path}: must not include {name}, of a floor above" for name in includes(text)
                  if is_ours(name) and room(name) == "dem" and ".." not in name
                  and floor_of_dem(name) not in below]
    for path in sorted(SPECIFICATION & tree.keys()):
        lines = tree[path].count("\n")
        if lines > MOST_LINES:
            found.append(f"{path}: {lines} lines, at most {MOST_LINES}: it is to be read")
        words = {word.lower() for word in re.findall("[A-Z]*[a-z]+|[A-Z]+", tree[path])}
        found += [f"{path}: {word}: that is for dem/ranks" for word in sorted(words & WORDS_OF_RANKS)]
    return found


def heavy_headers(tree):
    """Includes that make a header, and so all who read it, slow to compile."""
    return [f"{path}: must not include {name}, which is slow to compile: the sources that need it do"
            for path, text in tree.items() if path.endswith(".hpp") for name in includes(text)
            for heavy, allowed in HEAVY.items()
            if path not in allowed and (name == heavy or heavy.endswith("/") and name.startswith(heavy))]


def violations(tree):
    """Every forbidden include, file in no room and cycle of units of a tree, one line each, and what
    violations_in_dem() and heavy_headers() find."""
    found = violations_in_dem(tree) + heavy_headers(tree)
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
