# SPDX-License-Identifier: GPL-3.0-or-later
"""The arguments of the package's functions: objects in place of files, and words for errors.

After an error the arguments are compared with the annotations of the function. The first that does not fit is named in one
line, with what it is and what to give. Nothing is compared before an error: a function may take more than it says.
"""
import collections.abc
import difflib
import functools
import inspect
import numbers
import os
import types
import typing

import numpy as np

from . import _objects
from ._calotte import Density, Error, Mesh, Polygons, Surface

_WORDS = {int: "a whole number", float: "a number", bool: "True or False", str: "text", os.PathLike: "the name of a file",
          collections.abc.Mapping: "a dict", collections.abc.Sequence: "a list", collections.abc.Callable: "a function"}
_SCALARS = {int: numbers.Integral, float: numbers.Real, bool: (bool, np.bool_)}


def _kinds(annotation):
    """The kinds of a union, the origin of list[int] and the like; empty where anything may fit."""
    if typing.get_origin(annotation) in (typing.Union, types.UnionType):
        kinds = [_kinds(each) for each in typing.get_args(annotation)]
        return [kind for each in kinds for kind in each] if all(kinds) else []
    kind = typing.get_origin(annotation) or annotation
    if kind in (_objects.Geometries, _objects.LabelledRaster):  # it became a file
        return [os.PathLike]
    if kind in (Density, Surface):  # _arguments knows what else may be one
        return []
    known = isinstance(kind, type) and kind not in (np.ndarray, typing.Any) and not getattr(kind, "_is_protocol", False)
    return [kind] if known else []


def _fits(value, kind):
    if kind in _SCALARS:
        is_bool = isinstance(value, _SCALARS[bool])
        scalar = value[()] if isinstance(value, np.ndarray) and value.ndim == 0 else value
        return isinstance(scalar, _SCALARS[kind]) and (kind is bool or not is_bool)
    return isinstance(value, kind)


def _with_article(name):
    return name if name.endswith("s") else f"{'an' if name[0] in 'AEIOUaeiou' else 'a'} {name}"


def described(value):
    if value is None or isinstance(value, (str, numbers.Number, np.bool_)):
        return repr(value)
    if isinstance(value, np.ndarray):
        return f"an array of the shape {value.shape}"
    return _with_article(type(value).__name__)


def _expected(kinds):
    if os.PathLike in kinds:  # of a path, which may be text, too
        kinds = [kind for kind in kinds if kind is not str]
    words = [_WORDS.get(kind) or _with_article(kind.__name__) for kind in dict.fromkeys(kinds) if kind is not type(None)]
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))


def _hint(value, kinds):
    """How to make a mesh of what was given in its place."""
    if Mesh not in kinds:
        return ""
    if isinstance(value, Polygons):
        return "; polygons have no triangles"
    if isinstance(value, (str, os.PathLike)):
        return f", such as read({os.fspath(value)!r})"
    return ", which delaunay() makes of points" if isinstance(value, (np.ndarray, list, tuple)) else ""


def _require(given, kinds):
    """Refuses the first argument that is not what its annotation says."""
    for name, value in given.items():
        expected = kinds.get(name)
        if expected and not any(_fits(value, kind) for kind in expected):
            raise Error(f"{name} is {described(value)}; give {_expected(expected)}{_hint(value, expected)}") from None


def _bound(signature, name, given, words):
    """The arguments by their names; a misspelt name is answered with the nearest that there is."""
    try:
        return signature.bind(*given, **words)
    except TypeError as error:
        known = [each.name for each in signature.parameters.values() if each.kind is not each.POSITIONAL_ONLY]
        unknown = [word for word in words if word not in known]
        near = difflib.get_close_matches(unknown[0], known, 1) if unknown else []
        remedy = f"did you mean {near[0]}?" if near else f"its arguments are {', '.join(known)}"
        raise TypeError(f"{name}() {error}; {remedy}") from None


def checked(function):
    """The function, whose errors of types name the argument."""
    signature = inspect.signature(function)
    kinds = {name: _kinds(hint) for name, hint in typing.get_type_hints(function).items()}
    kinds = {each.name: kinds[each.name] for each in signature.parameters.values()
             if each.name in kinds and each.kind not in (each.VAR_POSITIONAL, each.VAR_KEYWORD)}

    @functools.wraps(function)
    def call(*given, **words):
        bound = _bound(signature, function.__name__, given, words)
        try:
            with _objects.in_files(bound, plane=function.__name__ == "planar_polygon"):
                return function(*bound.args, **bound.kwargs)
        except Error:
            raise
        except (AttributeError, TypeError, ValueError) as error:
            _require(bound.arguments, kinds)
            if "incompatible function arguments" not in str(error):  # of the compiled part
                raise
            what = ", ".join(f"{name} is {described(value)}" for name, value in bound.arguments.items())
            raise Error(f"{function.__name__}() cannot use an argument: {what}; see help({function.__name__})") from None

    return call


def check_all(names, names_of):
    """Replaces the functions among the names of a module."""
    for name in names:
        if inspect.isfunction(names_of[name]):
            names_of[name] = checked(names_of[name])
