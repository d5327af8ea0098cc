"""Runs examples/batch/slurm.sh in a Slurm cluster of two nodes with one processor each, on this machine. Needs root."""
import os
import pathlib
import re
import signal
import socket
import subprocess
import tempfile
import time

import faqem

# A task that is started again waits for twice the life of credentials (cred_expire, seconds), by default for minutes.
CONFIGURATION = """
ClusterName=faqem
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge,cred_expire=5
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/controller.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/controller.log
SlurmdLogFile={folder}/%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
SelectType=select/cons_tres
SchedulerParameters=batch_sched_delay=1,sched_interval=5
ReturnToService=2
SlurmdTimeout=6
RequeueExit=75
MailProg=/bin/true
NodeName=node1 NodeHostname=localhost NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1
NodeName=node2 NodeHostname=localhost NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1
PartitionName=all Nodes=node1,node2 Default=YES MaxTime=INFINITE State=UP
"""

nodes = {}  # the process of each, by its name


def free_ports(count):
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def start(*command):
    return subprocess.Popen(command, start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def output(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def start_node(name):
    nodes[name] = start("slurmd", "-D", "-N", name, "-d", "/usr/sbin/slurmstepd-wlm")


def parent_of(process):
    return int(pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])


def lose_node(command):
    """Ends the node of a command with all its processes, and starts it again when the controller has noticed."""
    variables = pathlib.Path(f"/proc/{command}/environ").read_bytes().decode().split("\0")
    name = next(one for one in variables if one.startswith("SLURMD_NODENAME=")).partition("=")[2]
    for process in (nodes[name].pid, parent_of(command), command):
        os.kill(process, signal.SIGKILL)
    nodes[name].wait()
    while "down" not in output("sinfo", "--noheader", "--nodes=" + name, "--format=%T"):
        time.sleep(0.5)
    start_node(name)


def run(job):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for one in ("state", "node1", "node2"):
            (folder / one).mkdir()
        (folder / "slurm.conf").write_text(CONFIGURATION.format(folder=folder, ports=free_ports(3)))
        (folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")
        (folder / "key").touch(0o600)
        (folder / "key").write_bytes(os.urandom(128))
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
        others = [start("munged", "-F", "--force", *(f"--{option}={folder}/{file}" for option, file in (
            ("socket", "munge"), ("key-file", "key"), ("log-file", "log"), ("pid-file", "pid"), ("seed-file", "seed"))))]
        while not (folder / "munge").exists():
            time.sleep(0.1)
        others.append(start("slurmctld", "-D"))
        for one in ("node1", "node2"):
            start_node(one)
        try:
            run_jobs(job)
        finally:
            for process in (*nodes.values(), *reversed(others)):
                process.terminate()
                process.wait()


def run_jobs(job):
    path = os.path.dirname(faqem._command.program()) + ":" + os.environ["PATH"]
    subprocess.run(["sh", job.examples / "slurm.sh", job.list, job.out, str(job.shards), *job.words], check=True,
                   cwd=job.folder, env={**os.environ, **job.faults, "PATH": path}, stdout=subprocess.DEVNULL)
    while queue := output("squeue", "--noheader"):
        assert "DependencyNeverSatisfied" not in queue
        time.sleep(0.5)
    last = max(job.folder.glob("slurm-*.out"), key=lambda file: int(re.match("slurm-([0-9]+)", file.name)[1]))
    assert "poisoned: 2" in last.read_text(), last.read_text()
