# A batch on a cluster that loses nodes, cables and its controller ends complete, each line
# once and with the bytes of a run on one machine.
# Usage: batch.bash TURNWRIGHT DATA_FOLDER [LINES]
set -euo pipefail
turnwright=$1 data=$2 lines=${3:-1200}
source "$(dirname "${BASH_SOURCE[0]}")/cluster.bash"
if ! why=$(cluster_can); then
  echo "SKIPPED: NO CLUSTER WAS TESTED: $why"
  exit 0
fi
exec 9> /tmp/turnwright-cluster.lock
flock 9  # one such cluster on a machine

folder=$(mktemp -d)
end() {
  local status=$?
  if ((status)); then
    echo "failed in $folder"
    cluster_run squeue --array || true
    tail -n 20 "$folder"/cluster/ctl.log || true
  fi
  cluster_down
  ((status)) || rm -rf "$folder"
}
trap end EXIT
cd "$folder"
say() { printf '%4d s  %s\n' $SECONDS "$*"; }

for ((i = 1; i <= lines; ++i)); do
  if ((lines <= 1000 || i % 10 == 0)); then
    printf '{"name": "multipass", "document": {"dt_mm": 5.%04d}}\n' "$i"
  else
    printf '{"name": "acceptance", "document": {"cases": [{"id": "%d", "tolerance": "diameter", "e_mm": [0, 0.%04d], "upper_mm": 0.2, "lower_mm": -0.2}]}}\n' "$i" "$i"
  fi
done > lines.jsonl
"$turnwright" --data "$data" batch lines.jsonl -o alone > /dev/null
say "$lines lines on this machine alone"

cluster_up "$folder/cluster" 3
cp -r cluster/state before
say "controller and three nodes are up"
batch() {
  cluster_run timeout 200 "$turnwright" --data "$data" batch lines.jsonl -o results \
    --task-lines $((lines / 25)) "$@"
}
running_on() { cluster_run squeue --noheader --states=running --nodelist="$1" | grep -q .; }
until_running_on() {
  for ((i = 0; i < 100; ++i)); do
    running_on "$1" && return
    sleep 0.1
  done
  echo "nothing runs on $1" >&2
  return 1
}
same() { # what stands there is what one machine gave
  cmp alone/results.jsonl results/results.jsonl
  cmp alone/summary.json results/summary.json
  grep -o '^{"line":[0-9]*' results/results.jsonl | sort -u | wc -l | grep -qx "$lines"
}

# A node dies, another one is cut off and goes on for itself.
batch --chunk 10 --slurm
if batch --slurm 2> error; then exit 1; fi
grep -q "tasks of this batch are in Slurm's queue; --reconcile waits for them" error
until_running_on w1
cluster_kill w1
say "node w1 killed while it worked"
until_running_on w2
cluster_cut w2
say "node w2 cut off while it worked"
batch --reconcile
same
say "complete: every line once"
cluster_heal w2
cluster_start w1

# The controller dies right after it has taken an array, and forgets that and all before: it
# gives out the same job numbers again, which node w2, once cut off, may still hold and refuse.
mv results first
batch --chunk 10 --slurm
cluster_kill ctl
rm -rf cluster/state
mv before cluster/state
say "controller killed right after it took the array; it does not remember"
batch --reconcile > reconciled &
reconcile=$!
sleep 3
cluster_start ctl
wait $reconcile
cat reconciled
same
say "complete again"
