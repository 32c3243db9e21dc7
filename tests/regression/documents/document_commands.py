"""The commands that a document gives, and running them as they stand."""

import os
import re
import subprocess
import sys
from pathlib import Path

from program import NO_FIGURES, PROGRAM, SOURCES


def commands(document, heading):
    """The lines of the first block of code below a heading."""
    text = Path(SOURCES, document).read_text()
    return re.search(rf"^## {re.escape(heading)}\n.*?^```\n(.*?)^```", text,
                     re.DOTALL | re.MULTILINE).group(1).splitlines()


def run(call, folder_in_text, folder, figures=True):
    """What a command comes to if it writes to another folder than the text has it, and draws no figures
    if nobody looks at them."""
    words = call.replace(folder_in_text, str(folder)).split()
    words[0] = {"./listric": PROGRAM, "python3": sys.executable, "/usr/bin/python3": sys.executable}[words[0]]
    return subprocess.run(words, cwd=SOURCES, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, env=os.environ | ({} if figures else NO_FIGURES))
