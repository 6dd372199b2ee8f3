# SPDX-License-Identifier: Apache-2.0
"""The files of a repository, for scripts that check them."""
import subprocess


def tracked_files(root, parser):
    """Paths of all files that git knows or would add, less those deleted; wrong usage where there is no repository."""
    try:
        listing = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root,
                                 check=True, capture_output=True, text=True).stdout
    except OSError as error:
        parser.error(f"{error.filename}: {error.strerror}")
    except subprocess.CalledProcessError as error:
        parser.error(f"{root}: {error.stderr.partition(chr(10))[0]}")
    return sorted(name for name in set(listing.split("\0")) if name and (root / name).is_file())
