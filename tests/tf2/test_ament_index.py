# SPDX-License-Identifier: Apache-2.0
"""Search for packages."""

import pytest

from ament_index_python import (
    InvalidResourceNameError,
    InvalidResourceTypeNameError,
    PackageNotFoundError,
    get_search_paths,
)
from ament_index_python.constants import RESOURCE_INDEX_SUBFOLDER
from ament_index_python.packages import (
    get_package_prefix,
    get_package_share_directory,
    get_package_share_path,
    get_packages_with_prefixes,
)
from ament_index_python.resources import get_resource, get_resource_types, get_resources, has_resource


@pytest.fixture
def places(tmp_path, monkeypatch):
    """Create an installed package `arm`, a source package `rover`, and a package `shared` in both places."""
    prefix, sources = tmp_path / "install", tmp_path / "src"
    index = prefix / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    for name in ("arm", "shared"):
        (index / name).touch()
        (prefix / "share" / name).mkdir()
    for name in ("rover", "shared"):
        (sources / name).mkdir(parents=True)
        (sources / name / "package.xml").touch()
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/nowhere:{prefix}")
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(sources))
    return prefix, sources


def test_installed_packages_and_source_trees(places):
    prefix, sources = places
    assert get_package_share_directory("arm") == str(prefix / "share" / "arm")
    assert get_package_prefix("arm") == str(prefix)
    assert get_package_share_path("rover") == sources / "rover"
    assert get_package_prefix("shared") == str(prefix)
    found = get_packages_with_prefixes()
    assert found.items() >= {"arm": str(prefix), "shared": str(prefix), "rover": str(sources)}.items()
    assert found["tf2_ros"] == get_package_prefix("tf2_ros"), "coframe's own packages are listed, too"


def test_error_for_a_missing_package_lists_the_searched_directories(places):
    with pytest.raises(PackageNotFoundError) as caught:
        get_package_share_directory("gripper")
    assert str(caught.value).startswith(f"package 'gripper' not found, searching: ['{places[0]}', '{places[1]}']")
    assert isinstance(caught.value, KeyError)


@pytest.mark.parametrize("name", ["", "../etc", "a/b", "1st"])
@pytest.mark.usefixtures("places")
def test_invalid_package_names(name):
    with pytest.raises(ValueError, match="is not a valid package name"):
        get_package_share_directory(name)


def test_resources_of_the_index(places):
    prefix, _ = places
    folder = prefix / RESOURCE_INDEX_SUBFOLDER / "plugins"
    folder.mkdir()
    (folder / "arm").write_text("gripper.xml")
    assert get_search_paths() == [str(prefix)]
    assert get_resource("plugins", "arm") == ("gripper.xml", str(prefix))
    assert get_resources("packages") == {"arm": str(prefix), "shared": str(prefix)}
    assert get_resource_types() == {"packages", "plugins"}
    assert has_resource("plugins", "arm") == str(prefix)
    assert has_resource("plugins", "rover") is False
    assert get_resources("nothing") == {}
    with pytest.raises(LookupError, match="Could not find the resource 'rover' of type 'plugins'"):
        get_resource("plugins", "rover")
    with pytest.raises(InvalidResourceTypeNameError):
        get_resources("a/b")
    with pytest.raises(InvalidResourceNameError):
        get_resource("plugins", "../x")
