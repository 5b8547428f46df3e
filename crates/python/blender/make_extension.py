#!/usr/bin/env python3
"""Builds the Blender extension: a zip with the panel and the wheels of the module, one for each platform.

    python make_extension.py WHEEL... -o burgeon-blender.zip

Install it in Blender with Edit > Preferences > Get Extensions > Install from Disk.
"""

import argparse
import re
import sys
import zipfile
from pathlib import Path

# Platforms of Blender by the platforms in the names of wheels.
PLATFORMS = {
    r"manylinux\w*_x86_64|linux_x86_64": "linux-x64",
    r"win_amd64": "windows-x64",
    r"win_arm64": "windows-arm64",
    r"macosx\w*_arm64": "macos-arm64",
    r"macosx\w*_x86_64": "macos-x64",
}


def platform_of(wheel: Path) -> str:
    """Returns Blender's name for the platform of a wheel."""
    tag = wheel.stem.rsplit("-", 1)[-1]
    for pattern, platform in PLATFORMS.items():
        if re.search(pattern, tag):
            return platform
    sys.exit(f"{wheel.name}: Blender does not run on {tag}; wheels for it end with {', '.join(PLATFORMS)}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("wheels", nargs="+", type=Path, help="wheels of the Python module")
    parser.add_argument("-o", "--output", type=Path, default=Path("burgeon-blender.zip"), help="zip to write")
    arguments = parser.parse_args()
    source = Path(__file__).parent / "extension"
    for wheel in arguments.wheels:
        if not wheel.is_file():
            sys.exit(f"{wheel}: no such wheel")
    names = ", ".join(f'"./wheels/{wheel.name}"' for wheel in arguments.wheels)
    platforms = ", ".join(f'"{it}"' for it in sorted({platform_of(wheel) for wheel in arguments.wheels}))
    manifest = (source / "blender_manifest.toml").read_text(encoding="utf-8")
    manifest = manifest.replace("wheels = []", f"wheels = [{names}]\nplatforms = [{platforms}]")
    with zipfile.ZipFile(arguments.output, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("blender_manifest.toml", manifest)
        for path in sorted(source.glob("*.py")):
            archive.write(path, path.name)
        for wheel in arguments.wheels:
            archive.write(wheel, f"wheels/{wheel.name}", zipfile.ZIP_STORED)
    print(arguments.output)


if __name__ == "__main__":
    main()
