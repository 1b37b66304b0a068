# Runs every command of docs/guide.md in its order, and compares answers and pictures with
# what the guide shows of them.
# Usage: guide.bash TURNWRIGHT SOURCE_FOLDER [--update]    (puts the pictures there instead)
set -euo pipefail
turnwright=$1 source=$2 update=${3:-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
ln -s "$source"/{parts,docs} .
export TURNWRIGHT_DATA=$source
commands=0 lines=0 failed=0

run() { # COMMAND LINE
  local wanted=0 status=0
  [[ $1 =~ '# exit '([0-9]+) ]] && wanted=${BASH_REMATCH[1]}
  read -ra words <<< "${1%%#*}"
  "$turnwright" "${words[@]:1}" > answer 2>&1 || status=$?
  commands=$((commands + 1))
  if ((status != wanted)); then
    echo "exit $status instead of $wanted: $1"
    cat answer
    failed=1
  fi
}

while IFS= read -r line; do
  [[ $line == '    '* ]] || continue
  line=${line:4}
  if [[ $line == '$ turnwright '* ]]; then
    run "${line#$ }"
  else
    lines=$((lines + 1))
    grep -qxF -- "$line" answer || { echo "not in the answer: $line"; failed=1; }
  fi
done < "$source/docs/guide.md"

pictures=$source/docs/pictures/guide
while read -r shown made; do
  if [[ $update ]]; then
    cp "$made" "$pictures/$shown"
  else
    cmp "$made" "$pictures/$shown" || failed=1
  fi
done << END
setup-1.svg pictures/setup-1.svg
budget.svg pictures/budget.svg
window.svg pictures/window-s1-finish-pin.svg
trace.svg $(echo trace/*.svg)
stability.svg keyed/stability-s1-mill-k1.svg
END
((commands > 5 && lines > 10)) || { echo "the guide shows nothing"; failed=1; }
exit $failed
