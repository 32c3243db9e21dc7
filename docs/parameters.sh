#!/bin/bash
# Writes docs/parameters.md, docs/calls.md, the schemas of scenes and materials, the dictionary of measures
# and the tables of docs/measures.md from the program's own declarations.
cd "$(dirname "$0")/.." || exit
reference=$(./listric explain --parameters) || exit
cat >docs/parameters.md <<END
# Parameters of a scene

Made by \`docs/parameters.sh\` from \`./listric explain --parameters\`; a test compares the two. A table
is an effect where it says so: then the effect is on exactly when the table is there.

\`\`\`
$reference
\`\`\`
END
scene=$(./listric schema) && material=$(./listric schema --material) || exit
echo "$scene" >apps/scene.schema.json
echo "$material" >apps/material.schema.json
measures=$(./listric schema --measures) || exit
echo "$measures" >apps/python/listric/dictionary.json
python3 -B docs/measures.py

# The launcher prints these texts where the program is not built.
help() { COLUMNS=80 "${LISTRIC_BUILD:-build}/${LISTRIC_PRESET:-native}/listric" help "$@"; }
overview=$(help) || exit
{
    cat <<END
# Help of all calls

Made by \`docs/parameters.sh\` from \`listric help CALL\`; a test compares the two. [Commands](commands.md)
shows what the calls are for.

## listric

\`\`\`
$overview
\`\`\`
END
    for call in $(sed -n '/^Options/q; s/^  \([a-z]*\)  .*/\1/p' <<<"$overview"); do
        printf '\n## %s\n\n```\n%s\n```\n' "$call" "$(help "$call")"
    done
} >docs/calls.md
