"""Makes what fails smaller while it fails in the same way; at most until a time of time.monotonic()."""

import math
import time


def shrink_list(parts, fails, budget=200, end=math.inf):
    """The fewest parts of a list with which `fails(parts)` is still true (Zeller & Hildebrandt 2002, ddmin);
    at most `budget` tries."""
    size = max(1, len(parts) // 2)
    tries = 0

    def may_try():
        return tries < budget and time.monotonic() < end

    while size >= 1 and may_try():
        begin, shrunk = 0, False
        while begin < len(parts) and may_try():
            fewer = parts[:begin] + parts[begin + size:]
            tries += 1
            if fewer and fails(fewer):
                parts, shrunk = fewer, True
            else:
                begin += size
        if not shrunk:
            size = size // 2
    return parts


def shrink_scene(scene, fails, base, budget=200, end=math.inf):
    """The fewest tables and keys of a scene, {table: {key: value}}, with which it fails; what `base` has
    takes its value there where that fails, too."""
    pairs = [(table, None) for table in scene if table not in base]
    pairs += [(table, key) for table in scene for key in scene[table]
              if base.get(table, {}).get(key) != scene[table][key]]

    def with_changes(kept):
        made = {table: dict(keys) for table, keys in base.items() if table in scene}
        made.update({table: {} for table, key in kept if key is None})
        for table, key in kept:   # keys of a table that is left out go with it
            if key is not None and table in made:
                made[table][key] = scene[table][key]
        return made

    if not pairs or time.monotonic() > end or not fails(with_changes(pairs)):
        return scene   # the base's own, or a table that is missing
    if fails(with_changes([])):
        return with_changes([])
    return with_changes(shrink_list(pairs, lambda kept: fails(with_changes(kept)), budget, end))


def shrink_text(data, fails, budget=200, end=math.inf):
    """The fewest lines, then bytes, of a file that fails."""
    lines = shrink_list(data.splitlines(keepends=True), lambda kept: fails(b"".join(kept)), budget, end)
    data = b"".join(lines)
    if len(data) > 2000:
        return data
    return bytes(shrink_list(list(data), lambda kept: fails(bytes(kept)), budget, end))
