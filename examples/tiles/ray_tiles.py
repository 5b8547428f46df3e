"""Makes tiles with Ray: ray_tiles.py SCRIPT DATA FOLDER WORKERS or CLUSTER [OPTIONS OF PLAN]

Workers share the folder. A share is repeated if a worker dies or a file could not be written (status 75). Needs: pip install ray
"""

import subprocess
import sys

import ray


def burgeon(*arguments):
    """Runs a command, and returns its status."""
    return subprocess.run(["burgeon", "tiles", *arguments], check=False).returncode


@ray.remote(num_cpus=1, max_retries=3, retry_exceptions=[OSError])
def make(folder, share, shares):
    """Makes a share. Raises an error only if another attempt may help."""
    status = burgeon("make", folder, "--threads", "1", "--share", f"{share}/{shares}")
    if status not in (0, 1):
        raise OSError(f"share {share} ended with status {status}")
    return status


if __name__ == "__main__":
    script, data, folder, at, *options = sys.argv[1:]
    ray.init(num_cpus=int(at)) if at.isdigit() else ray.init(address=at)
    shares = 4 * int(ray.cluster_resources()["CPU"])
    if burgeon("plan", script, "--data", data, "-o", folder, *options) != 0:
        sys.exit(1)
    made = [make.remote(folder, share, shares) for share in range(1, shares + 1)]
    statuses = ray.get(made)
    # The join lists the features that are missing, with their causes.
    status = burgeon("join", folder) or burgeon("check", folder)
    sys.exit(status or int(any(statuses)))
