# Sourced by the other scripts: an environment of its own, made once and kept up to date.
#
# use_environment EXTRAS  makes .venv where it is missing, installs this package with the extras
# that are asked for, and puts it on the PATH. AGV_MOTION_VENV names another place.
# use_pytest              after it: lets pytest start quickly, with the plugins of these tests.

set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
venv=${AGV_MOTION_VENV:-$root/.venv}

newest_python() {
    for python in python3.13 python3.12 python3.11 python3.10 python3 python; do
        if "$python" -c 'import sys; sys.exit(not (3, 10) <= sys.version_info < (3, 15))' 2>/dev/null; then
            echo "$python"
            return
        fi
    done
    echo 'error: no Python 3.10 to 3.14 was found: install one (apt install python3 python3-venv)' >&2
    exit 1
}

# Without a pip of its own an environment is made in a moment: the one that Python brings takes eight
# seconds to unpack, and is old and slow. It comes from the pip of the base, where that is new enough.
bring_pip() {
    [ ! -e "$venv/agv_motion.pip" ] || return 0
    "$(newest_python)" -m pip --python "$venv/bin/python" install --quiet --no-compile \
        --disable-pip-version-check pip setuptools 2>/dev/null || {
        "$venv/bin/python" -m ensurepip >/dev/null &&
            "$venv/bin/python" -m pip install --quiet --upgrade --disable-pip-version-check \
                pip setuptools
    } || {
        echo 'error: this Python has no pip, or no way to its packages: see above;' \
            'on Debian and Ubuntu: apt install python3-pip python3-venv' >&2
        exit 1
    }
    touch "$venv/agv_motion.pip"
}

# What is imported is compiled as it is: that of all that is installed takes twice as long. Of the
# build nothing is fetched for it alone, since setuptools is there. uv, where it is, is the quickest.
install() {
    if command -v uv >/dev/null; then
        uv pip install --quiet --python "$venv/bin/python" pip setuptools "$1" && return
        echo 'uv could not (see above): once more, by pip' >&2
    fi
    bring_pip
    "$venv/bin/python" -m pip install --quiet --no-compile --no-build-isolation \
        --disable-pip-version-check "$1"
}

use_environment() {
    stamp="$venv/agv_motion.$1"
    if [ ! -x "$venv/bin/python" ]; then
        python=$(newest_python)
        echo "Making an environment in $venv with $($python --version)" >&2
        "$python" -m venv --without-pip "$venv" || {
            rm -rf "$venv"
            echo 'error: this Python cannot make environments: apt install python3-venv' >&2
            exit 1
        }
    fi
    if [ ! -e "$stamp" ] || [ -n "$(find "$root/agv_motion" "$root/config" "$root/launch_scripts" \
        "$root/setup.py" "$root/package.xml" -newer "$stamp" -print -quit)" ]; then
        echo "Installing agv_motion[$1]; the first time this takes a minute" >&2
        rm -rf "$root/build"
        install "$root[$1]"
        touch "$stamp"
    fi
    PATH="$venv/bin:$PATH"
    AMENT_PREFIX_PATH="$venv${AMENT_PREFIX_PATH:+:$AMENT_PREFIX_PATH}"
    ROS_AUTOMATIC_DISCOVERY_RANGE=${ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}
    export PATH AMENT_PREFIX_PATH ROS_AUTOMATIC_DISCOVERY_RANGE
    unset PYTHONDONTWRITEBYTECODE  # bytecode is kept, whatever the machine's habit
}

use_pytest() {
    # away from the sources: without bytecode each of some hundred processes compiles all it imports
    export PYTHONPYCACHEPREFIX="$venv/bytecode"
    # the plugins that these tests need, and none of those that happen to be installed
    export PYTEST_DISABLE_PLUGIN_AUTOLOAD=1
    export PYTEST_PLUGINS=_hypothesis_pytestplugin,pytest_timeout,xdist.plugin
}
