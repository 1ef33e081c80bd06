"""What a peer is asked for, and how its processes are run and measured."""
import os
import re
import shutil
import subprocess
import tempfile
import time


class Refused(Exception):
    """The peer cannot render this scene as it is."""


class Failed(Exception):
    """The peer was started and did not do what it was asked for."""


class Job:
    def __init__(self, output, budgets, seed, threads, size, throughput_only):
        self.output, self.budgets, self.seed, self.threads = output, budgets, seed, threads
        self.size, self.throughput_only = size, throughput_only

    def path(self, spp):
        return self.output.replace("%d", str(spp))

    def record(self, peer, version, spp, **figures):
        """One line of the results; figures as in README.md."""
        return {"peer": peer, "version": version, "spp": spp, "seed": self.seed, "threads": self.threads, **figures}


class Run:
    """A process that has ended: what it said (stdout and stderr in one), and what it took."""

    def __init__(self, command, folder):
        with tempfile.TemporaryFile() as said:
            begin = time.monotonic()
            process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=said, stderr=said)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            self.wall_s = time.monotonic() - begin
            said.seek(0)
            self.text = said.read().decode("utf-8", "replace")
        self.peak_mb = usage.ru_maxrss * 1024e-6
        if process.returncode:
            end = "\n".join(self.text.splitlines()[-15:])
            raise Failed(f"{command[0]} ended with {process.returncode}:\n{end}")


def refuse(name, problems):
    """problems: what the peer cannot do, each as the end of a sentence; none is as well."""
    if problems:
        raise Refused(f"{name} cannot render " + "; nor ".join(problems))


def version_of(command, pattern):
    """The group of the pattern in what a command says, on either way, whatever it ends with."""
    if not shutil.which(command[0]):
        return "unknown"
    said = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    found = re.search(pattern, said.stdout.decode("utf-8", "replace"))
    return found.group(1) if found else "unknown"
