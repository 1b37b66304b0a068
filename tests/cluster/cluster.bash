# A Slurm cluster on one machine, to be sourced: a controller and workers, each in network,
# mount and host name spaces of its own, joined by a bridge.  Needs root, no systemd.
#
#   cluster_can             tells on standard output what is missing; fails if anything is
#   cluster_up FOLDER N     controller at 10.77.0.1, workers w1 .. wN of two cores each
#   cluster_kill NAME       ends worker or controller (ctl) at once, with all its processes
#   cluster_start NAME      the same one again
#   cluster_cut NAME        pulls its network cable;  cluster_heal NAME plugs it in
#   cluster_run COMMAND..   runs it beside the controller
#   cluster_down            ends and removes all of it
#
# Names of the name spaces begin with twc, so that nothing else is touched.

cluster_can() {
  local tool missing=()
  for tool in slurmctld slurmd munged sbatch squeue scontrol ip nsenter unshare; do
    PATH=$PATH:/usr/sbin:/sbin command -v "$tool" > /dev/null || missing+=("$tool")
  done
  if ((${#missing[@]})); then
    echo "not installed: ${missing[*]} (Debian: slurmctld slurmd slurm-client munge iproute2)"
    return 1
  fi
  if ((EUID != 0)) || ! unshare --net --mount --uts --pid --fork true 2> /dev/null; then
    echo "no right to make name spaces"
    return 1
  fi
}

# "ip netns exec" would mount /sys anew and hide what slurmd looks for there.
cluster_in() { nsenter --net="/run/netns/twc-$1" "${@:2}"; }

cluster_wire() { # NAME ADDRESS
  ip netns add "twc-$1"
  ip link add "twc-$1" netns twc-switch type veth peer name eth0 netns "twc-$1"
  cluster_in switch ip link set "twc-$1" master br0 up
  cluster_in "$1" ip address add "10.77.0.$2/24" dev eth0
  cluster_in "$1" ip link set eth0 up
  cluster_in "$1" ip link set lo up
}

cluster_settings() { # N
  cat << END
ClusterName=turnwright
SlurmctldHost=ctl(10.77.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CryptoType=crypto/munge
AuthInfo=socket=$cluster/munge.socket
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool-%n
SlurmctldPidFile=$cluster/ctl.pid
SlurmdPidFile=$cluster/%n.pid
SlurmctldLogFile=$cluster/ctl.log
SlurmdLogFile=$cluster/%n.log
TmpFS=$cluster/tmp
MailProg=/bin/true
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=1,bf_interval=1
CompleteWait=0
KillWait=3
SlurmdTimeout=10
ReturnToService=2
JobRequeue=1
END
  local i
  for ((i = 1; i <= $1; ++i)); do
    echo "NodeName=w$i NodeAddr=10.77.0.$((10 + i)) CPUs=2 State=UNKNOWN"
  done
  echo "PartitionName=all Nodes=w[1-$1] Default=YES MaxTime=INFINITE State=UP"
}

# The pid name space takes everything in it along when its first process is killed, as a
# power cut does.
cluster_start() {
  local daemon=(slurmd -D -N "$1" -f "$cluster/slurm.conf")
  [[ $1 == ctl ]] && daemon=(slurmctld -D -f "$cluster/slurm.conf")
  setsid nsenter --net="/run/netns/twc-$1" \
    unshare --mount --uts --pid --fork --kill-child --mount-proc \
    bash -c 'hostname "$0"; exec "$@"' "$1" "${daemon[@]}" \
    > "$cluster/$1.out" 2>&1 9>&- &
  cluster_pid[$1]=$!
}

cluster_kill() {
  local pid=${cluster_pid[$1]} i
  unset "cluster_pid[$1]"
  disown "$pid" 2> /dev/null || true
  kill -9 "$pid" 2> /dev/null || return 0
  for ((i = 0; i < 50; ++i)); do
    kill -0 "$pid" 2> /dev/null || return 0
    sleep 0.1
  done
}

cluster_cut() { cluster_in switch ip link set "twc-$1" down; }
cluster_heal() { cluster_in switch ip link set "twc-$1" up; }
cluster_run() { cluster_in ctl "$@"; }

cluster_up() { # FOLDER N
  cluster=$1
  export SLURM_CONF=$cluster/slurm.conf PATH=$PATH:/usr/sbin:/sbin
  declare -gA cluster_pid=()
  mkdir -p "$cluster"/{state,tmp}
  cluster_settings "$2" > "$SLURM_CONF"
  head -c 32 /dev/urandom > "$cluster/munge.key"
  chmod 600 "$cluster/munge.key"
  munged --force --foreground --key-file="$cluster/munge.key" \
    --socket="$cluster/munge.socket" --pid-file="$cluster/munge.pid" \
    --seed-file="$cluster/munge.seed" > "$cluster/munge.out" 2>&1 9>&- &
  cluster_pid[munge]=$!
  ip netns add twc-switch
  cluster_in switch ip link add br0 type bridge
  cluster_in switch ip link set br0 up
  cluster_wire ctl 1
  cluster_start ctl
  local i
  for ((i = 1; i <= $2; ++i)); do
    cluster_wire "w$i" $((10 + i))
    mkdir -p "$cluster/spool-w$i"
    cluster_start "w$i"
  done
  for ((i = 0; i < 60; ++i)); do
    [[ $(cluster_run sinfo --noheader --states=idle --format=%D 2> /dev/null) == "$2" ]] &&
      return
    sleep 0.5
  done
  echo "the cluster does not come up:" >&2
  tail -n 5 "$cluster"/*.log "$cluster"/*.out >&2
  return 1
}

cluster_down() {
  local name
  for name in "${!cluster_pid[@]}"; do cluster_kill "$name"; done
  for name in $(ip netns list | grep -o '^twc-[a-z0-9]*'); do ip netns delete "$name"; done
}
