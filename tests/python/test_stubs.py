import ast
import inspect

import drape
from conftest import SOURCE

STUBS = ast.parse((SOURCE / "python/drape/__init__.pyi").read_text())


def names_in(body):
    return {node.name for node in body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}


def public(of):
    return {name for name in vars(of) if not name.startswith("_")}


def test_the_stubs_name_what_there_is():
    assert names_in(STUBS.body) == set(drape.__all__)
    for node in STUBS.body:
        if isinstance(node, ast.ClassDef) and not issubclass(getattr(drape, node.name), Exception):
            assert {name for name in names_in(node.body) if not name.startswith("_")} == public(getattr(drape, node.name)), node.name


def test_everything_is_documented_with_its_arguments():
    for name in drape.__all__:
        thing = getattr(drape, name)
        assert inspect.getdoc(thing), name
        if inspect.isclass(thing) and not issubclass(thing, Exception):
            for member in public(thing):
                assert inspect.getdoc(getattr(thing, member)), f"{name}.{member}"
    for node in ast.walk(STUBS):
        if isinstance(node, ast.FunctionDef) and node.args.args and node.name in ("step", "restore", "use_data_folder"):
            said = getattr(drape.Simulation, node.name, None) or getattr(drape, node.name)
            for argument in node.args.args:
                assert argument.arg in said.__doc__.splitlines()[0], (node.name, argument.arg)
