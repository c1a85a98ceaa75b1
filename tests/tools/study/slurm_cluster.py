"""A Slurm cluster of this host alone, on loopback, for as long as a test runs."""
import os
import shutil
import socket
import subprocess
import time

CONFIGURATION = """ClusterName=tilepress
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
StateSaveLocation={folder}/ctld
SlurmdSpoolDir={folder}/d
SlurmctldPidFile={folder}/ctld.pid
SlurmdPidFile={folder}/d.pid
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
ReturnToService=2
NodeName=localhost NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=d Nodes=localhost Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
"""


def free_ports(count):
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


def host_name_resolves():
    try:
        return bool(socket.getaddrinfo(socket.gethostname(), None))
    except OSError:
        return False


def is_possible():
    """Slurm's daemons are there, this process may run them, and the system has what they insist on. A bare chroot may
    have neither an address for the host's name nor control groups."""
    path = os.environ["PATH"] + ":/usr/sbin:/sbin"
    return (os.geteuid() == 0 and host_name_resolves() and os.path.ismount("/sys/fs/cgroup") and
            all(shutil.which(name, path=path) for name in ("slurmctld", "slurmd", "sbatch")))


class SlurmCluster:
    """`environment` makes the commands of Slurm talk to this cluster."""

    def __init__(self, folder):
        self.folder = folder
        for name in ("ctld", "d"):
            os.makedirs(os.path.join(folder, name))
        configuration = os.path.join(folder, "slurm.conf")
        with open(configuration, "w", encoding="utf-8") as file:
            file.write(CONFIGURATION.format(folder=folder, ports=free_ports(2), cpus=os.cpu_count()))
        self.environment = {**os.environ, "SLURM_CONF": configuration,
                            "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}
        self.daemons = []

    def __enter__(self):
        for name in ("slurmctld", "slurmd"):
            with open(os.path.join(self.folder, name + ".log"), "wb") as log:
                self.daemons.append(subprocess.Popen([shutil.which(name, path=self.environment["PATH"]), "-D"],
                                                     env=self.environment, stdout=log, stderr=log))
        deadline = time.monotonic() + 120
        while self.answer("sinfo", "-h", "-o", "%t").strip() != "idle":
            assert time.monotonic() < deadline, "the cluster does not start"
            time.sleep(0.2)
        return self

    def __exit__(self, *_):
        self.answer("scancel", "-u", "root")
        for daemon in reversed(self.daemons):
            daemon.terminate()
            daemon.wait()

    def answer(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, timeout=60, check=False).stdout

    def wait_until_empty(self, timeout=300):
        """Waits until no job is queued or runs."""
        deadline = time.monotonic() + timeout
        while self.answer("squeue", "-h").strip():
            assert time.monotonic() < deadline, self.answer("squeue")
            time.sleep(0.2)
