# Runs the clients of docs/examples against a server.
# Usage: examples.bash TURNWRIGHT SOURCE_FOLDER
set -euo pipefail
turnwright=$1 source=$2
for tool in curl python3; do
  command -v "$tool" >/dev/null || { echo "SKIPPED: no $tool"; exit 0; }
done
folder=$(mktemp -d)
trap 'kill "$server" 2>/dev/null || true; rm -rf "$folder"' EXIT
cd "$folder"
"$turnwright" serve --port 0 --jobs jobs.sqlite > said 2> log &
server=$!
for _ in $(seq 300); do grep -q http said && break; sleep 0.1; done
url=$(sed -n 's|.*\(http://[^/]*\)/.*|\1|p' said)

expect() { grep -q -- "$1" out || { echo "no '$1' in:"; cat out; exit 1; }; }
part=$source/parts/pump-shaft.json

"$source/docs/examples/plan.py" "$part" "$url" > out
expect '^ok: [0-9.]* per part, gap'
expect 'saves .* per part'
"$source/docs/examples/plan.sh" "$part" "$url" > out
expect '"cost_per_part": [0-9.]*,'
grep -q '<h1>' report.html

sed 's/"length_mm": 40/"length_mm": -40/' "$part" > wrong.json
status=0
"$source/docs/examples/plan.py" wrong.json "$url" > out || status=$?
[[ $status == 2 ]]
expect 'got -40, expected a number > 0'

# The server stops when it is asked, with nothing left undone.
kill -TERM "$server"
wait "$server"
echo "examples: all answered"
