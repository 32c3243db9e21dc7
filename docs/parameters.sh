#!/bin/bash
# Writes the schemas of scenes, plans and materials, the dictionary of measures and the help of all
# calls from the program's own declarations, and of these docs/parameters.md, docs/calls.md and the measures of
# docs/measures.md and docs/validation-measures.md. LISTRIC names another program than that of build/native.
cd "$(dirname "$0")/.." || exit
[[ $LISTRIC ]] || ./listric scenes >/dev/null || exit # builds it
listric=${LISTRIC:-${LISTRIC_BUILD:-build}/${LISTRIC_PRESET:-native}/listric}
scene=$("$listric" schema) && material=$("$listric" schema --material) && flexure=$("$listric" schema --flexure) &&
    sweep=$("$listric" schema --sweep) && validation=$("$listric" schema --validation) && measures=$("$listric" schema --measures) || exit
echo "$scene" >apps/scene.schema.json
echo "$material" >apps/material.schema.json
echo "$flexure" >apps/flexure.schema.json
echo "$sweep" >apps/sweep.schema.json
echo "$validation" >apps/validation.schema.json
echo "$measures" >apps/python/listric/dictionary.json
python3 -B docs/parameters.py && python3 -B docs/measures.py

# The launcher prints these texts where the program is not built.
help() { COLUMNS=80 "$listric" help "$@"; }
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
