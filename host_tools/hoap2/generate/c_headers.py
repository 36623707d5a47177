"""C headers: signal structs, their field tables, the robot model."""

from __future__ import annotations

import math

from .tables import Signal, Table

BANNER = "/* Generated from firmware/signals.toml and firmware/hoap2.json by ./hoap2 generate: do not edit. */\n"
AXES = {(1, 0, 0): 0, (0, 1, 0): 1, (0, 0, 1): 2}


def number(x: float) -> str:
    """A C double literal that reads back to the same bits."""
    text = repr(float(x))
    return {"inf": "HUGE_VAL", "-inf": "-HUGE_VAL"}.get(text, text)


def _guard(name: str, body: str, includes: str = "#include <stdint.h>\n") -> str:
    return f"{BANNER}#ifndef {name}\n#define {name}\n{includes}\n{body}\n#endif\n"


def _struct(table: Table, product: str, group: str, tag: str) -> str:
    lines = []
    for s in table.select(product, group):
        ctype = "double" if s.kind == "real" else "int32_t"
        dims = "".join(f"[{n}]" for n in s.shape)
        unit = f" [{s.unit}]" if s.kind == "real" else ""
        lines.append(f"  {ctype} {s.name}{dims}; /* {s.text}{unit} */")
    last = table.select(product, group)[-1].name
    # an odd number of ints leaves padding behind them, which a copy of the whole struct would carry along
    named = (f"/* bytes of its members, without the padding behind the last one */\n"
             f"#define {tag.upper()}_BYTES (offsetof({tag}_t, {last}) + sizeof(((const {tag}_t *)0)->{last}))\n")
    return "typedef struct {\n" + "\n".join(lines) + f"\n}} {tag}_t;\n{named}"


def _initialiser(s: Signal) -> str:
    values = [number(v) if s.kind == "real" else str(int(v)) for v in s.default]
    return values[0] if not s.shape else "{" + ", ".join(values) + "}"


def _defaults(table: Table, product: str, group: str, tag: str) -> str:
    """A macro that fills a struct with the defaults (loops for constant arrays keep it short)."""
    lines = []
    for s in table.select(product, group):
        ctype = "double" if s.kind == "real" else "int32_t"
        target = f"(({ctype} *)(void *)&(p)->{s.name})"
        if len(set(s.default)) == 1:
            value = number(s.default[0]) if s.kind == "real" else str(int(s.default[0]))
            lines.append(f"  for (int i_ = 0; i_ < {s.count}; ++i_) {target}[i_] = {value};")
        else:
            lines.append(f"  {{ static const {ctype} v_[{s.count}] = {_initialiser(s)};\n"
                         f"    for (int i_ = 0; i_ < {s.count}; ++i_) {target}[i_] = v_[i_]; }}")
    body = "\n".join(lines)
    return f"static inline void {tag}_defaults({tag}_t *p) {{\n{body}\n}}\n"


def _ranges(table: Table, product: str, tag: str) -> str:
    """A function that counts the parameters outside their range (NaN counts)."""
    lines = []
    for s in table.select(product, "parameter"):
        ctype = "double" if s.kind == "real" else "int32_t"
        low, high = (number(s.low), number(s.high)) if s.kind == "real" else (int(s.low), int(s.high))
        lines.append(f"  for (int i_ = 0; i_ < {s.count}; ++i_) {{ const {ctype} v_ = ((const {ctype} *)(const void *)&p->{s.name})[i_];"
                     f" if (!(v_ >= {low} && v_ <= {high})) ++bad_; }}")
    body = "\n".join(lines)
    return f"static inline int {tag}_out_of_range(const {tag}_t *p) {{\n  int bad_ = 0;\n{body}\n  return bad_;\n}}\n"


def _input_ranges(table: Table, product: str) -> str:
    """LOW and HIGH of the inputs that have a range."""
    rows = [s for s in table.select(product, "input") if s.low > -math.inf]
    return "".join(f"#define HOAP2_{s.name.upper()}_{end} {number(x) if s.kind == 'real' else int(x)}\n"
                   for s in rows for end, x in (("LOW", s.low), ("HIGH", s.high)))


def _tune(table: Table, product: str, tag: str) -> str:
    """A function that takes over the tunable parameters and leaves all others; none without a tunable one."""
    rows = [s for s in table.select(product, "parameter") if s.tunable]
    if not rows:
        return ""
    lines = []
    for s in rows:
        ctype, cast = "double" if s.kind == "real" else "int32_t", "(void *)&"
        lines.append(f"  for (int i_ = 0; i_ < {s.count}; ++i_) (({ctype} *){cast}to->{s.name})[i_] = "
                     f"((const {ctype} *)(const void *)&from->{s.name})[i_];")
    body = "\n".join(lines)
    return f"static inline void {tag}_tune({tag}_t *to, const {tag}_t *from) {{\n{body}\n}}\n"


def _enums(table: Table, used: set[str]) -> str:
    out = []
    for name, values in table.enums.items():
        if name in used:
            items = ", ".join(f"HOAP2_{name.upper()}_{v.upper()} = {i}" for i, v in enumerate(values))
            out.append(f"enum {{ {items} }};")
    return "\n".join(out) + "\n"


def signals_header(table: Table, product: str, prefix: str) -> str:
    """Structs `<prefix>_{inputs,outputs,params}_t`, defaults and range checks of one product."""
    used = {s.enum for s in table.signals if s.product == product and s.enum}
    # both products speak of the drive modes: the firmware's header owns them
    shared = {s.enum for s in table.signals if s.product == "controller" and s.enum} | {"sensor_preset"}
    body = ""
    if product == "controller":
        used |= shared
        body += f"enum {{ HOAP2_TICK_US = {table.tick_us}, HOAP2_SCHEMA = {table.schema} }};\n"
        body += "\n".join(f"enum {{ HOAP2_SIZE_{k.upper()} = {v} }};" for k, v in table.sizes.items()) + "\n"
        body += "\n".join(f"enum {{ HOAP2_FAULT_{k.upper()} = {v} }};" for k, v in table.faults.items()) + "\n"
        body += _enums(table, used) + "\n"
    else:
        body += _enums(table, used - shared) + "\n"
    for group, tag in (("input", "inputs"), ("output", "outputs"), ("parameter", "params")):
        body += _struct(table, product, group, f"{prefix}_{tag}") + "\n"
    body += _defaults(table, product, "input", f"{prefix}_inputs") + "\n"
    body += _defaults(table, product, "parameter", f"{prefix}_params") + "\n"
    body += _input_ranges(table, product) + "\n"
    body += _ranges(table, product, f"{prefix}_params")
    body += _tune(table, product, f"{prefix}_params")
    includes = "#include <math.h>\n#include <stddef.h>\n#include <stdint.h>\n"
    if product == "plant":
        includes += '#include "hoap2/generated/signals.h"\n'
    return _guard(f"{prefix.upper()}_GENERATED_SIGNALS_H", body, includes)


def _vec(values) -> str:
    return "{" + ", ".join(number(v) for v in values) + "}"


def _tree_order(robot: dict) -> list[int]:
    """Joint indices such that each parent link stands before its children."""
    done, order, joints = {robot["base_link"]}, [], robot["joints"]
    while len(order) < len(joints):
        for i, j in enumerate(joints):
            if i not in order and j["parent"] in done:
                order.append(i)
                done.add(j["child"])
    return order


def robot_header(table: Table) -> str:
    """The robot as constant tables: links, joints, feet, sensors, servo."""
    robot = table.robot
    link_index = {link["name"]: i for i, link in enumerate(robot["links"])}
    out = [f"#define HOAP2_JOINTS {len(robot['joints'])}", f"#define HOAP2_LINKS {len(robot['links'])}",
           f"#define HOAP2_TOTAL_MASS_KG {number(robot['total_mass_kg'])}"]
    out.append("enum { " + ", ".join(f"HOAP2_J_{j['name'].upper()} = {i}" for i, j in enumerate(robot["joints"])) + " };")
    out.append("enum { " + ", ".join(f"HOAP2_L_{n.upper()} = {i}" for n, i in link_index.items()) + " };")
    out.append("""
typedef struct {
  double mass_kg;
  double com_L_m[3];
  double inertia_C_kgm2[6]; /* ixx iyy izz ixy ixz iyz */
  double box_min_L_m[3];
  double box_max_L_m[3];
} hoap2_link_data_t;

typedef struct {
  int parent_link;
  int child_link;
  int axis; /* 0 x, 1 y, 2 z: joint axes are parallel to the frame axes */
  double origin_parent_m[3];
  double limit_soft_rad[2];
  double limit_hard_rad[2];
  double velocity_limit_rad_s;
  double torque_continuous_Nm;
  double torque_peak_Nm;
  double armature_kgm2;
  double friction_coulomb_Nm;
  double friction_viscous_Nms_rad;
  int count_sign;
} hoap2_joint_data_t;
""")
    rows = []
    for link in robot["links"]:
        inertia = [link["inertia_C_kgm2"][k] for k in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")]
        rows.append(f"  /* {link['name']} */ {{{number(link['mass_kg'])}, {_vec(link['com_L_m'])}, {_vec(inertia)}, "
                    f"{_vec(link['box_min_L_m'])}, {_vec(link['box_max_L_m'])}}}")
    out.append("static const hoap2_link_data_t HOAP2_LINK[HOAP2_LINKS] = {\n" + ",\n".join(rows) + "};")
    rows = []
    for j in robot["joints"]:
        rows.append(f"  /* {j['name']} */ {{{link_index[j['parent']]}, {link_index[j['child']]}, {AXES[tuple(j['axis'])]}, "
                    f"{_vec(j['origin_parent_m'])}, {_vec(j['limit_soft_rad'])}, {_vec(j['limit_hard_rad'])}, "
                    f"{number(j['velocity_limit_rad_s'])}, {number(j['torque_continuous_Nm'])}, {number(j['torque_peak_Nm'])}, "
                    f"{number(j['armature_kgm2'])}, {number(j['friction_coulomb_Nm'])}, {number(j['friction_viscous_Nms_rad'])}, {j['count_sign']}}}")
    out.append("static const hoap2_joint_data_t HOAP2_JOINT[HOAP2_JOINTS] = {\n" + ",\n".join(rows) + "};")
    out.append("/* joint indices, each parent link before its children */")
    out.append("static const int HOAP2_TREE_ORDER[HOAP2_JOINTS] = {" + ", ".join(map(str, _tree_order(robot))) + "};")
    out += _feet_and_sensors(robot)
    return _guard("HOAP2_GENERATED_ROBOT_MODEL_H", "\n".join(out), "")


def _feet_and_sensors(robot: dict) -> list[str]:
    feet, imu, servo = robot["feet"], robot["imu"], robot["servo"]
    cells = ", ".join(_vec(c) for c in feet["cells_foot_frame_m"])
    link = next(i for i, name in enumerate(link["name"] for link in robot["links"]) if name == imu["link"])
    scalars = {
        "SOLE_BELOW_ANKLE_M": feet["sole_height_below_ankle_m"], "ANKLE_TO_TOE_M": feet["ankle_to_toe_m"],
        "ANKLE_TO_HEEL_M": feet["ankle_to_heel_m"], "SOLE_HALF_WIDTH_M": feet["half_width_m"],
        "STEP_WIDTH_M": feet["step_width_nominal_m"], "RAD_PER_COUNT": servo["rad_per_count"],
        "ACCEL_LSB_M_S2": imu["accel_lsb_m_s2"], "ACCEL_BANDWIDTH_HZ": imu["accel_bandwidth_hz"],
        "ACCEL_RANGE_M_S2": imu["accel_range_m_s2"], "GYRO_LSB_RAD_S": imu["gyro_lsb_rad_s"],
        "GYRO_BANDWIDTH_HZ": imu["gyro_bandwidth_hz"], "GYRO_RANGE_RAD_S": imu["gyro_range_rad_s"],
    }
    out = [f"#define HOAP2_{name} {number(value)}" for name, value in scalars.items()]
    out.append(f"#define HOAP2_IMU_LINK {link}")
    out.append(f"static const double HOAP2_IMU_POS_L_M[3] = {_vec(imu['position_L_m'])};")
    out.append("/* force cells in the foot link frame, order of the cell labels */")
    out.append(f"static const double HOAP2_CELL_POS_L_M[4][3] = {{{cells}}};")
    return out


def names_header(table: Table) -> str:
    """Names for screens and error messages; the firmware does not need them."""
    robot = table.robot
    joints = ", ".join(f'"{j["name"]}"' for j in robot["joints"])
    links = ", ".join(f'"{link["name"]}"' for link in robot["links"])
    faults = ",\n".join(f'  {{{bit}, "{name}", "{table.fault_texts[name]}"}}' for name, bit in table.faults.items())
    body = (f"static const char *const HOAP2_JOINT_NAME[] = {{{joints}}};\nstatic const char *const HOAP2_LINK_NAME[] = {{{links}}};\n"
            f"typedef struct {{\n  int bit;\n  const char *name;\n  const char *text;\n}} hoap2_fault_name_t;\n"
            f"static const hoap2_fault_name_t HOAP2_FAULT_NAME[{len(table.faults)}] = {{\n{faults}}};\n"
            f"enum {{ HOAP2_FAULT_NAMES = {len(table.faults)} }};")
    return _guard("HOAP2_GENERATED_NAMES_H", body, "")
