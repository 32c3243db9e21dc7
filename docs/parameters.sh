#!/bin/bash
# Writes docs/parameters.md from the program's own declarations.
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
