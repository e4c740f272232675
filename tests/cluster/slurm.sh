#!/bin/sh
# slurm.sh DRAPE: runs a sweep of twelve runs on two Slurm nodes of this machine, one of which is killed half-way; resubmits and
# merges it, and compares it with the result of one process. Exits with 77 (skipped) unless script/cluster runs it.
set -eu
drape=$1
if [ -z "${DRAPE_CLUSTER:-}" ]; then
  echo "skipped: run by script/cluster, which installs Slurm"
  exit 77
fi

place=$(mktemp -d)
started=
end() {
  # shellcheck disable=SC2086 # one word for each process
  [ -z "$started" ] || { kill $started && wait $started; } 2>/dev/null || true # they write here until they have ended
  rm -rf "$place"
}
trap end EXIT
cd "$place"

wait_until() { # SECONDS WHAT COMMAND...: until the command succeeds
  left=$(($1 * 5))
  what=$2
  shift 2
  until "$@" >/dev/null 2>&1; do
    left=$((left - 1))
    if [ "$left" = 0 ]; then
      echo "$what: it did not come to that" >&2
      tail -n 20 ./*.log out/*.log >&2 || true
      exit 1
    fi
    sleep 0.2
  done
}

# Starts its own munge and cluster, independent of others on this machine: two nodes are two slurmd with their own ports.
mkdir munge state spool
chmod 700 munge state
dd if=/dev/urandom of=munge/key bs=1 count=128 2>/dev/null
chmod 400 munge/key
socket=$place/munge/socket
munged --force --foreground --key-file="$place/munge/key" --socket="$socket" --pid-file="$place/munge/pid" \
  --log-file="$place/munge.log" --seed-file="$place/munge/seed" >munged.log 2>&1 &
started="$started $!"
port=$((20000 + $$ % 20000))
cat >slurm.conf <<CONF
ClusterName=drape
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
MinJobAge=300
SchedulerParameters=sched_interval=1,batch_sched_delay=0
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool/%n
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd-%n.pid
SlurmctldLogFile=$place/slurmctld.log
SlurmdLogFile=$place/slurmd-%n.log
NodeName=n1 NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1
NodeName=n2 NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF="$place/slurm.conf"
wait_until 10 munge test -S "$socket"
slurmctld -D >slurmctld.out 2>&1 &
started="$started $!"
slurmd -D -N n1 >n1.out 2>&1 &
started="$started $!"
slurmd -D -N n2 >n2.out 2>&1 &
second=$!
started="$started $second"
both_idle() { [ "$(sinfo --noheader --Node --format=%T | sort -u)" = idle ]; }
wait_until 60 "two idle nodes" both_idle

cat >plan.toml <<PLAN
[cloth]
mesh = { grid = [12, 12] }
stiffness = 50
pins = ["corner:x-y-"]
[time]
step = 0.01
duration = 8
[integrator]
method = "implicit"
[effects.gravity]
[sweep.vary]
cloth.stiffness = "10..60/6"
integrator.method = ["liu13", "implicit"]
PLAN

"$drape" sweep plan.toml -o whole --quiet

complete() { find out/shard-* -name run.json 2>/dev/null | wc -l; }
some_complete() { [ "$(complete)" -ge 2 ]; }
nothing_queued() { [ -z "$(squeue --noheader)" ]; }

"$drape" sweep plan.toml -o out --slurm 4 --submit
wait_until 120 "two runs that are complete" some_complete
kill -9 "$second" # a node is lost, and what runs on it
pkill -9 -P "$second" 2>/dev/null || true
echo "a node lost after $(complete) of 12 runs"
scancel --name=drape-sweep # as a person does who sees it
wait_until 120 "an empty queue" nothing_queued
slurmd -D -N n2 >>n2.out 2>&1 &
started="$started $!"
wait_until 60 "two idle nodes again" both_idle
echo "resubmitted after $(complete) of 12 runs"
"$drape" sweep plan.toml -o out --slurm 4 --submit
wait_until 240 "an empty queue again" nothing_queued

# Measured values differ every time: step_us.…, effect_shares.…, seconds, timed.
without_times() {
  awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) kept[i] = $i !~ /^(step_us\.|effect_shares\.|seconds$|timed$)/ }
           { line = ""; for (i = 1; i <= NF; i++) if (kept[i]) line = line $i ","; print line }' "$1"
}
without_times whole/runs.csv >whole.txt
without_times out/runs.csv >out.txt
[ "$(wc -l <whole.txt)" = 13 ]
diff whole.txt out.txt
echo "12 runs over two nodes are as of one process"
