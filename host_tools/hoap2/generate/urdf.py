"""URDF export of hoap2.json, for tools and for the independent oracles of the tests."""

from __future__ import annotations

from .tables import Table


def _v(values) -> str:
    return " ".join(repr(float(v)) for v in values)


def urdf(table: Table) -> str:
    robot = table.robot
    out = ['<?xml version="1.0"?>', "<!-- Generated from firmware/hoap2.json by ./hoap2 generate: do not edit. -->",
           f'<robot name="{robot["name"]}">']
    for link in robot["links"]:
        i = link["inertia_C_kgm2"]
        tensor = " ".join(f'{k}="{i[k]!r}"' for k in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))
        low, high = link["box_min_L_m"], link["box_max_L_m"]
        box = (f'<origin xyz="{_v((a + b) / 2 for a, b in zip(low, high))}"/>'
               f'<geometry><box size="{_v(b - a for a, b in zip(low, high))}"/></geometry>')
        out.append(f'  <link name="{link["name"]}">\n'
                   f'    <inertial><origin xyz="{_v(link["com_L_m"])}"/><mass value="{link["mass_kg"]!r}"/><inertia {tensor}/></inertial>\n'
                   f"    <visual>{box}</visual>\n    <collision>{box}</collision>\n  </link>")
    for j in robot["joints"]:
        low, high = j["limit_hard_rad"]
        out.append(f'  <joint name="{j["name"]}" type="revolute"><parent link="{j["parent"]}"/><child link="{j["child"]}"/>'
                   f'<origin xyz="{_v(j["origin_parent_m"])}"/><axis xyz="{_v(j["axis"])}"/>'
                   f'<limit lower="{low!r}" upper="{high!r}" effort="{j["torque_peak_Nm"]!r}" velocity="{j["velocity_limit_rad_s"]!r}"/></joint>')
    return "\n".join(out) + "\n</robot>\n"
