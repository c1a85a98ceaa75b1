#!/usr/bin/env bash
# The Python module of an installed tree, which codec.package left behind. Only that tree and the tests are used.
# Usage: python_test.sh SOURCE_FOLDER PACKAGE_WORK_FOLDER
set -euo pipefail
source=$1 prefix="$2/a place/moved"
python=/usr/bin/python3
[ -x "$python" ] || python=python3
package=$(echo "$prefix"/lib/python*/dist-packages)
for file in __init__.py py.typed _native.pyi; do
  [ -f "$package/tilepress/$file" ] || { echo "not installed: $package/tilepress/$file"; exit 1; }
done
cd "$source/tests/tools/python"
TILEPRESS_TEST_PLUGIN=$2/plugin/librowpal.so PYTHONPATH=$package PYTHONDONTWRITEBYTECODE=1 exec "$python" -m pytest -q -p no:cacheprovider -W error::pytest.PytestWarning .
