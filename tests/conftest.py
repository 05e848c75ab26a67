"""What all tests share: derived facts are kept in one folder of the test run, never in the user's."""

import os
import tempfile

from hypothesis import settings

os.environ.setdefault("UCRIT_CACHE", os.path.join(tempfile.gettempdir(), f"ucrit-tests-{os.getuid()}"))
settings.register_profile("default", deadline=None, derandomize=True)
settings.load_profile("default")
