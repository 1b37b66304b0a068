# Runs a test in the environment that wheel.bash has made.
# Usage: inside.bash WORK_FOLDER TEST.py ARGUMENT..
set -euo pipefail
python=$1/environment/bin/python
[[ -x $python ]] || { echo 'SKIPPED: NOT CHECKED: there is no wheel'; exit 0; }
cd "$1" # a folder without the sources
exec "$python" "${@:2}"
