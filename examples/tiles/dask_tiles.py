"""Makes tiles with Dask: dask_tiles.py SCRIPT DATA FOLDER WORKERS or SCHEDULER [OPTIONS OF PLAN]

Workers share the folder. A share is repeated if a file could not be written (status 75). Needs: pip install distributed
"""

import subprocess
import sys

from distributed import Client


def burgeon(*arguments):
    """Runs a command, and returns its status."""
    return subprocess.run(["burgeon", "tiles", *arguments], check=False).returncode


def make(folder, share, shares):
    """Makes a share. Raises an error only if another attempt may help."""
    status = burgeon("make", folder, "--threads", "1", "--share", f"{share}/{shares}")
    if status not in (0, 1):
        raise OSError(f"share {share} ended with status {status}")
    return status


if __name__ == "__main__":
    script, data, folder, at, *options = sys.argv[1:]
    client = Client(n_workers=int(at), threads_per_worker=1) if at.isdigit() else Client(at)
    shares = 4 * len(client.scheduler_info()["workers"])
    if burgeon("plan", script, "--data", data, "-o", folder, *options) != 0:
        sys.exit(1)
    made = [client.submit(make, folder, share, shares, retries=2, pure=False) for share in range(1, shares + 1)]
    failed = sum(bool(future.exception() or future.result()) for future in made)
    client.close()
    # The join lists the features that are missing, with their causes.
    status = burgeon("join", folder) or burgeon("check", folder)
    sys.exit(status or int(failed > 0))
