# Runs every command of docs/PAGE.md, or of PAGE.md, in its order, and compares answers and
# pictures with what the page shows of them.
# Usage: guide.bash TURNWRIGHT SOURCE_FOLDER PAGE LEAST_COMMANDS LEAST_LINES [--update]
# PAGE is guide, learn or README; --update puts the pictures there instead.
set -euo pipefail
turnwright=$1 source=$2 page=$3 least_commands=$4 least_lines=$5 update=${6:-}
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

page_file=$source/docs/$page.md
[[ -e $page_file ]] || page_file=$source/$page.md
answered=  # the lines are an answer: their block began with a command
while IFS= read -r line; do
  [[ $line ]] || continue
  [[ $line == '    '* ]] || { answered=; continue; }
  line=${line:4}
  if [[ $line == '$ turnwright '* ]]; then
    answered=1
    run "${line#$ }"
  elif [[ $answered ]]; then
    lines=$((lines + 1))
    grep -qxF -- "$line" answer || { echo "not in the answer: $line"; failed=1; }
  fi
done < "$page_file"

pictures=$source/docs/pictures/$page
while read -r shown made; do
  if [[ $update ]]; then
    cp "$made" "$pictures/$shown"
  else
    cmp "$made" "$pictures/$shown" || failed=1
  fi
done < <(grep "^$page " << END | cut -d' ' -f2-
guide setup-1.svg pictures/setup-1.svg
guide budget.svg pictures/budget.svg
guide window.svg pictures/window-s1-finish-pin.svg
guide trace.svg $(echo trace/*.svg)
guide stability.svg keyed/stability-s1-mill-k1.svg
learn run.svg run/run-2.svg
END
)
((commands >= least_commands && lines >= least_lines)) || { echo "$page.md shows too little"; failed=1; }
exit $failed
