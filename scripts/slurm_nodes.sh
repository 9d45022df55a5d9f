#!/usr/bin/env bash
# Slurm with two nodes on this machine, for tests: munge, slurmctld and two slurmd below FOLDER, as root, without accounting.
#   scripts/slurm_nodes.sh start FOLDER       prints the line that gives commands their SLURM_CONF
#   scripts/slurm_nodes.sh kill FOLDER NODE   ends a node (n1, n2) with all that runs on it, as a lost machine would
#   scripts/slurm_nodes.sh revive FOLDER NODE
#   scripts/slurm_nodes.sh stop FOLDER        ends everything that was started
# MAX_ARRAY=11 and PORT=17000 may be given.
set -euo pipefail
what=$1 dir=$(realpath -m "$2")
port=${PORT:-17000}

node() { # name: its slurmd, as a daemon
  SLURM_CONF=$dir/slurm.conf slurmd -f "$dir/slurm.conf" -N "$1"
}

start() {
  mkdir -p "$dir/state"
  chmod 755 "$dir"
  printf '%s\n' SlurmctldHost=localhost ClusterName=svt AuthType=auth/munge AuthInfo=socket="$dir/munge.sock" SlurmUser=root \
    ProctrackType=proctrack/linuxproc TaskPlugin=task/none SelectType=select/cons_tres SelectTypeParameters=CR_Core \
    JobAcctGatherType=jobacct_gather/none AccountingStorageType=accounting_storage/none SlurmdParameters=config_overrides \
    SlurmdTimeout=10 ReturnToService=2 KillWait=2 MaxArraySize="${MAX_ARRAY:-11}" SlurmctldPort="$port" SlurmdSpoolDir="$dir/%n" \
    SlurmdPidFile="$dir/%n.pid" SlurmctldPidFile="$dir/ctld.pid" StateSaveLocation="$dir/state" \
    SlurmctldLogFile="$dir/ctld.log" SlurmdLogFile="$dir/%n.log" SchedulerParameters=sched_interval=2,batch_sched_delay=0 \
    "NodeName=n1 NodeHostname=localhost Port=$((port + 1)) CPUs=1" "NodeName=n2 NodeHostname=localhost Port=$((port + 2)) CPUs=1" \
    "PartitionName=batch Nodes=ALL Default=YES State=UP" >"$dir/slurm.conf"
  echo CgroupPlugin=cgroup/v1 >"$dir/cgroup.conf"
  (umask 077 && head -c 1024 /dev/urandom >"$dir/munge.key")
  # munged distrusts a socket in a folder that others may write.
  munged --key-file="$dir/munge.key" --socket="$dir/munge.sock" --pid-file="$dir/munge.pid" --log-file="$dir/munge.log" \
    --seed-file="$dir/munge.seed" --force 2>>"$dir/start.log"
  export SLURM_CONF=$dir/slurm.conf
  slurmctld -f "$SLURM_CONF"
  mkdir -p "$dir/n1" "$dir/n2"
  node n1
  node n2
  for _ in $(seq 60); do
    [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ] && { echo "export SLURM_CONF=$dir/slurm.conf"; return; }
    sleep 0.5
  done
  echo "slurm_nodes: the nodes do not come up; logs in $dir" >&2
  exit 1
}

# Ends the process of a file, if it is the program that wrote it, and what it started: a slurmstepd stands in its own session.
end() { # file, program, signal
  local pid
  pid=$(cat "$1" 2>/dev/null) || return 0
  [ "$(cat "/proc/$pid/comm" 2>/dev/null)" = "$2" ] || return 0
  kill "-$3" "$pid" 2>/dev/null || return 0
  for _ in $(seq 20); do [ -e "/proc/$pid" ] || return 0; sleep 0.1; done
  kill -KILL "$pid" 2>/dev/null || true
}

# All processes below a process.
below() {
  local child
  cat /proc/"$1"/task/*/children 2>/dev/null | tr -s ' ' '\n' | while read -r child; do below "$child"; echo "$child"; done || true
}

# Steps of a node: slurmstepd whose environment or spool is that of this folder.
steps() { # node
  local process
  for process in /proc/[0-9]*; do
    [ "$(cat "$process/comm" 2>/dev/null)" = slurmstepd ] || continue
    find "$process/fd" -lname "*$dir/$1[./]*" 2>/dev/null | grep -q . && echo "${process#/proc/}"
  done || true
}

lose() { # node
  local step
  end "$dir/$1.pid" slurmd KILL
  for step in $(steps "$1"); do
    for process in $(below "$step") "$step"; do kill -KILL "$process" 2>/dev/null || true; done
  done
}

stop() {
  export SLURM_CONF=$dir/slurm.conf
  timeout 5 scancel --signal=KILL -u root 2>/dev/null || true
  timeout 5 scancel -u root 2>/dev/null || true
  lose n1
  lose n2
  end "$dir/ctld.pid" slurmctld TERM
  end "$dir/munge.pid" munged TERM
}

case $what in
  start) start ;;
  kill) lose "$3" ;;
  revive) node "$3" ;;
  stop) stop ;;
  *) echo "slurm_nodes: start, kill, revive or stop" >&2; exit 2 ;;
esac
