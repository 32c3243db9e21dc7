"""Scenes that `check` refuses, by what is wrong with them: most by what no schema knows."""

from program import SOURCES


def shipped(name):
    return (SOURCES / f"apps/scenes/{name}.toml").read_text()


def table(heading, **keys):
    lines = [f"{key} = {value}" for key, value in keys.items()]
    return "\n".join(["", heading, *lines, ""])


def layer(name="mica", material='"mica"', **keys):
    given = {"name": f'"{name}"', "material": material, **keys}
    return table("[[layer]]", **{key: value for key, value in given.items() if value is not None})


def bed(material='"mud"', **keys):
    given = {"material": material, **keys}
    return table("[[bed]]", **{key: value for key, value in given.items() if value is not None})


def stage(**keys):
    return table("[[stage]]", **keys)


def without(text, *lines):
    """A text without the lines that begin so."""
    return "\n".join(line for line in text.splitlines() if not line.startswith(lines)) + "\n"


def refused_scenes():
    lis1, elastic, mud = shipped("lis1"), shipped("lis1-elastic"), shipped("lis1-mud")
    free = without(lis1, "distance_m")                      # its stages say how far the wall goes
    ground = without(shipped("inversion-lis1").partition("[[stage]]")[0]) + "[gravity]\n[bonds]\n"
    bare = ground.replace("footwall_top_m = 30000.0", "")
    dry = without(lis1, "[sedimentation]", "level_m", "[compaction]")
    good = dict(top_m=2000.0, thickness_m=1000.0)
    return {
        # layers
        "no top": lis1 + layer(thickness_m=500.0),
        "two tops": lis1 + layer(**good, top="[[0.0, 1000.0], [40000.0, 1000.0]]"),
        "no bottom": lis1 + layer(top_m=1000.0),
        "two bottoms": lis1 + layer(**good, bottom_m=4000.0),
        "upside down": lis1 + layer(top_m=3000.0, bottom_m=2000.0),
        "upside down at one end": lis1 + layer(top="[[0.0, 1000.0], [40000.0, 4000.0]]", bottom_m=2000.0),
        "below the detachment": lis1 + layer(top_m=20000.0, thickness_m=1000.0),
        "thinner than a disc": lis1 + layer(top_m=2000.0, thickness_m=20.0),
        "overlap": lis1 + layer("a", **good) + layer("b", top_m=2500.0, thickness_m=1000.0),
        "one name for two": lis1 + layer(**good) + layer(top_m=5000.0, thickness_m=1000.0),
        "no name": lis1 + layer(**good).replace('name = "mica"\n', ""),
        "no material": lis1 + layer(material=None, **good),
        "unknown material": lis1 + layer(material='"granit"', **good),
        "unknown rock of faults": lis1 + layer(weakens_to='"granit"', **good),
        "one place of its top": lis1 + layer(top="[[0.0, 1000.0]]", thickness_m=-1.0),
        "a top that goes back": lis1 + layer(top="[[0.0, 1000.0], [9000.0, 900.0], [8000.0, 900.0]]", thickness_m=500.0),
        "a file that is not there": lis1 + layer(top_csv='"no-such.csv"', thickness_m=500.0),
        # stages
        "distance and pause": free + stage(distance_m=1000.0) + stage(distance_m=1000.0, pause_a=1e5),
        "neither distance nor pause": free + stage(distance_m=1000.0) + table("[[stage]]", base='"sheet"'),
        "a stage of nothing": free + stage(distance_m=0.0),
        "a pause with a rate": free + stage(distance_m=1000.0) + stage(pause_a=1e5, rate_m_per_a=0.01),
        "shortening without ground": bare + stage(distance_m=1000.0) + stage(distance_m=-500.0),
        "shorter than at the start": ground + stage(distance_m=1000.0) + stage(distance_m=-25000.0),
        "over the end of the ground": ground + stage(distance_m=1000.0) + stage(distance_m=-35000.0),
        "the whole hanging wall": ground + stage(distance_m=1000.0) + stage(distance_m=-41000.0),
        "farther than allowed": ground + stage(distance_m=2e6),
        "a distance beside stages": lis1 + stage(distance_m=1000.0),
        "stages of a stretching base": without(shipped("pure-shear"), "distance_m") + stage(distance_m=1000.0) + stage(distance_m=-500.0, base='"rests"'),
        "energy beside stages": ground + table("[energy]") + stage(distance_m=1000.0) + stage(distance_m=-500.0),
        # old faults
        "an old fault of no points": lis1 + table("[[old_fault]]", name='"f"'),
        "an old fault of one point": lis1 + table("[[old_fault]]", name='"f"', points="[[12000.0, 1000.0]]"),
        "an old fault outside": lis1 + table("[[old_fault]]", name='"f"', points="[[60000.0, 1000.0], [62000.0, 3000.0]]"),
        "an old fault below the detachment": lis1 + table("[[old_fault]]", name='"f"', points="[[12000.0, 20000.0], [13000.0, 21000.0]]"),
        "an old fault shorter than wide": lis1 + table("[[old_fault]]", name='"f"', points="[[12000.0, 1000.0], [12001.0, 1001.0]]"),
        "an old fault beside its file": lis1 + table("[[old_fault]]", name='"f"', csv='"f.csv"', points="[[12000.0, 1000.0], [14000.0, 3000.0]]"),
        "an old fault without detection": without(lis1, "[fault_weakening]", "[bond_healing]")
                                          + table("[[old_fault]]", name='"f"', points="[[12000.0, 1000.0], [14000.0, 3000.0]]"),
        # water
        "water heavier than grains": lis1 + table("[pore_fluid]", fluid_density_kg_per_m3=5000.0),
        "two levels of water": elastic + table("[pore_fluid]", level_m=-100.0),
        "two densities of water": elastic + table("[pore_fluid]", fluid_density_kg_per_m3=1100.0),
        "two waters of which one falls": (without(elastic, "distance_m") + table("[pore_fluid]")
                                          + stage(distance_m=1000.0, water_level_m=-100.0)),
        "a level of no water": free + stage(distance_m=1000.0, water_level_m=-100.0),
        "a bed of no age in between": mud + bed() + bed(),
        "beds that cross": mud + bed(until_a=2e5) + bed(until_a=1e5) + bed(),
        "beds that end": mud + bed(until_a=2e5) + bed(until_a=3e5),
        "a bed of no stratum": mud + bed(until_a=2e5) + bed(until_a=201e3) + bed(),
        "a bed of an unknown kind": mud + bed(material='"granit"'),
        "a bed of rock": mud + bed(material='"mica"'),
        "two laws of a bed": mud + bed(material=None, permeability_m2=1e-18, specific_surface_per_m=1e7),
        "clay of no mudstone": mud + bed(clay_fraction=0.5),
        "mudstone with a number": mud + bed(permeability_law='"mudstone"', permeability_m2=1e-18),
        "laminae of nothing": mud + bed(laminae_share=0.5),
        "laminae of no share": mud + bed(laminae='"sand"'),
        "beds without water": lis1 + bed(),
        "a crust thinner than the hanging wall": lis1 + table("[heat]", crust_m=10e3),
        "a crust that makes too much heat": lis1 + table("[heat]", heat_production_w_per_m3=1e-5),
        "a mantle that stretches below a crust that rests": lis1 + table("[heat]", mantle_width_m=1e5),
        "water without compaction": without(lis1, "[compaction]") + table("[pore_fluid]"),
        "water without sediment": dry + table("[pore_fluid]"),
        "water of the basin on a rigid base": lis1 + table("[basin_water]"),
        # the base
        "plates that are nowhere": elastic.replace("[basin_water]", "right_m = 10.0\n[basin_water]"),
        "a lighter mantle": elastic.replace("[basin_water]", "mantle_density_kg_per_m3 = 2000.0\n[basin_water]"),
        "thicker than deep": elastic.replace("elastic_thickness_m = 10000.0", "elastic_thickness_m = 500000.0"),
        "two that move the base": elastic + table("[base_motion]", uplift="[[0.0, 0.0], [40000.0, 100.0]]"),
        "a mesh that is not there": elastic.replace("[basin_water]", 'mesh_file = "no-such.msh"\n[basin_water]'),
        "motion of nothing": lis1 + table("[base_motion]"),
        "a fault of the basement below a detachment": lis1 + table("[base_motion]", fault_x_m=20000.0, fault_slip_m=100.0),
        "two motions": lis1 + table("[base_motion]", csv='"m.csv"', uplift="[[0.0, 0.0], [40000.0, 100.0]]"),
        # sediment
        "a target that goes back": lis1.replace("level_m = 0.0 ", "target = [[0.0, 0.0], [900.0, 9.0], [800.0, 9.0]] #"),
        "a file of targets that is not there": lis1.replace("level_m = 0.0 ", 'target_csv = "no-such.csv" #'),
        # keys and names
        "a key of JavaScript's": lis1 + table("[__proto__]", x=1),
        "a key of JavaScript's inside": lis1.replace("[extension]", "[extension]\n__proto__ = 1"),
        "a key that objects have": lis1 + table("[constructor]", x=1),
        "unknown rock": lis1.replace('"mat18-b" ', '"mat18-x" #'),
        "a rock that is no file": lis1.replace('"mat18-b" ', '"./no-such.toml" #'),
        "a control character": lis1.replace('"LIS1', '"LIS1\x01'),
        "half of a character": lis1.replace('"LIS1', '"LIS1 \\uD800'),
        # picks and the picture
        "a file of picks that is not there": lis1 + table("[observed]", horizons='"no-such.csv"'),
        "a picture without its place": lis1 + table("[observed]", picture='"section.png"'),
        "corners upside down": lis1 + table("[observed]", picture='"section.png"', corners_m="[0.0, 15000.0, 40000.0, 0.0]"),
        "three corners": lis1 + table("[observed]", picture='"section.png"', corners_m="[0.0, 15000.0, 40000.0]"),
    }
