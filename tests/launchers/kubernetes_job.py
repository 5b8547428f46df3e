"""Checks examples/tiles/kubernetes.yaml, and makes tiles as its pods would: kubernetes_job.py YAML SCRIPT DATA FOLDER WORKERS [OPTIONS]

The fields of the job and their types are those of batch/v1 in the client of Kubernetes. The rules between fields are those of its API
reference. Then the command of the container runs once for each index, with the policy of the job for exit statuses; the first attempt
of an index in four ends with a status that asks for another one. Needs: pip install kubernetes
"""

import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import kubernetes.client as api
import yaml

PRIMITIVES = {"str": str, "int": int, "bool": bool}


class UniqueKeys(yaml.SafeLoader):
    """Loader that refuses two values with the same key."""

    def construct_mapping(self, node, deep=False):
        keys = [key.value for key, _ in node.value]
        assert len(set(keys)) == len(keys), f"line {node.start_mark.line + 1} has a key twice: {keys}"
        return super().construct_mapping(node, deep)


def check_fields(value, kind, place):
    """Checks that a value has the fields and types of a kind of the client. Required fields are checked by its constructors."""
    if kind.lower().startswith("list["):
        assert isinstance(value, list), f"{place} is not a list"
        return [check_fields(item, kind[5:-1], f"{place}[{number}]") for number, item in enumerate(value)]
    if kind.lower().startswith(("dict(", "dict[")):
        item = kind[5:-1].split(", ")[1]
        return {key: check_fields(part, item, f"{place}.{key}") for key, part in value.items()}
    if kind in PRIMITIVES:
        # In Python, true is a number.
        assert type(value) is PRIMITIVES[kind], f"{place} is {value!r}, and not of type {kind}"
        return value
    model = getattr(api, kind, None)
    assert model is not None and isinstance(value, dict), f"{place} is {value!r}, and not a {kind}"
    names = {name: attribute for attribute, name in model.attribute_map.items()}
    unknown = set(value) - set(names)
    assert not unknown, f"{place} has the unknown fields {unknown}; a {kind} has {sorted(names)}"
    fields = {
        names[name]: check_fields(part, model.openapi_types[names[name]], f"{place}.{name}")
        for name, part in value.items()
    }
    return model(**fields)


def check_rules(job):
    """Checks the rules between the fields of a job, and that a status that asks for another attempt is not final."""
    assert (job.api_version, job.kind) == ("batch/v1", "Job")
    spec, pod = job.spec, job.spec.template.spec
    assert spec.completion_mode == "Indexed" and 0 < spec.parallelism <= spec.completions <= 100_000
    # A policy for failures requires that pods are not restarted in place; FailIndex requires a limit for each index.
    assert pod.restart_policy == "Never" and spec.backoff_limit_per_index > 0
    [rule] = spec.pod_failure_policy.rules
    values = rule.on_exit_codes.values
    assert (rule.action, rule.on_exit_codes.operator) == ("FailIndex", "In")
    assert values == sorted(set(values)) and all(0 < value < 256 for value in values)
    # 1: the script failed, 2: the command line is invalid. 75, 130 and 137 (a file, an interrupt, no memory) are worth a retry.
    assert values == [1, 2], values
    [container] = pod.containers
    mounts = {mount.name for mount in container.volume_mounts}
    assert mounts == {volume.name for volume in pod.volumes}
    command = container.command
    assert command[command.index("--of") + 1] == str(spec.completions), "the number of shares is not that of the pods"
    return container, container.volume_mounts[0].mount_path


def make(job, command, index, flaky):
    """Makes the share of an index as the job controller would, and returns the number of attempts."""
    final = job.spec.pod_failure_policy.rules[0].on_exit_codes.values
    environment = {**os.environ, "JOB_COMPLETION_INDEX": str(index)}
    for attempt in range(1, job.spec.backoff_limit_per_index + 2):
        first = [flaky, *command[1:]] if index % 4 == 1 and attempt == 1 else command
        status = subprocess.run(first, env=environment, check=False, capture_output=True, text=True)
        if status.returncode == 0:
            return attempt
        assert status.returncode not in final, f"index {index} failed: {status.stderr}"
    raise AssertionError(f"index {index} failed too often")


def main():
    file, script, data, folder, workers, *options = sys.argv[1:]
    with open(file, encoding="utf-8") as text:
        job = check_fields(yaml.load(text, UniqueKeys), "V1Job", "job")
    container, mount = check_rules(job)
    folder = os.path.abspath(folder)
    command = [folder if part == f"{mount}/out" else part for part in container.command]
    assert folder in command, "the command does not make the folder on the volume"
    subprocess.run(["burgeon", "tiles", "plan", script, "--data", data, "-o", folder, *options], check=True)
    with tempfile.TemporaryDirectory() as other:
        flaky = os.path.join(other, "burgeon")
        with open(flaky, "w", encoding="utf-8") as program:
            program.write("#!/bin/sh\nexit 75\n")
        os.chmod(flaky, 0o755)
        with ThreadPoolExecutor(int(workers)) as pods:
            indices = range(job.spec.completions)
            attempts = list(pods.map(lambda index: make(job, command, index, flaky), indices))
    assert max(attempts) == 2 and min(attempts) == 1, attempts
    for step in ["join", "check"]:
        subprocess.run(["burgeon", "tiles", step, folder], check=True)
    print(f"{job.spec.completions} indices, {sum(attempts)} attempts")


if __name__ == "__main__":
    main()
