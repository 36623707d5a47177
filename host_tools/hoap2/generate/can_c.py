"""C tables of the CAN interface: identifiers, field places, boards, CRC."""

from __future__ import annotations

from .c_headers import number
from .can_table import NODE_BITS, CanTable, Frame, Kind
from .tables import load_robot

BANNER = "/* Generated from firmware/can.toml and firmware/hoap2.json by ./hoap2 generate: do not edit. */\n"
CRC_SLICES = 4
BOARD_KINDS = ("drive", "rc", "foot", "posture")

TYPES = """
/* A field of a frame: value = raw * lsb. */
typedef struct {
  uint16_t first_bit;
  uint8_t bits;
  uint8_t kind; /* HOAP2_CAN_UNSIGNED, _SIGNED, _FLOAT */
  int32_t low;  /* raw */
  int32_t high;
  double lsb;
  double steps; /* 1 / lsb */
} hoap2_can_field_t;

/* A message on a bus. board: of the boards' table, -1 for the controller's frames to all. */
typedef struct {
  uint16_t identifier;
  uint16_t first_field;
  uint16_t used_bits;
  uint8_t length;
  uint8_t fields;
  uint8_t bus;
  uint8_t kind;   /* HOAP2_CAN_K_* */
  uint8_t sender; /* node */
  int8_t board;
  uint16_t period_ticks; /* 0: when needed */
  uint16_t offset_ticks;
} hoap2_can_layout_t;

typedef struct {
  uint8_t node;
  uint8_t bus;
  uint8_t kind; /* HOAP2_CAN_BOARD_* */
  uint8_t foot; /* of a foot board: 0 right, 1 left */
  uint8_t joints;
  uint8_t joint[HOAP2_CAN_BOARD_JOINTS];
} hoap2_can_board_data_t;

/* Gains of a drive that has lost its controller: the maker's servo. */
typedef struct {
  double kp_Nm_rad;
  double kd_Nms_rad;
} hoap2_can_servo_t;

typedef struct {
  float low;
  float high;
  uint8_t writable;
  uint8_t of_joint;
} hoap2_can_parameter_t;
"""


def crc_tables(poly: int) -> list[list[int]]:
    """Slices for a byte-wise CRC-8: slice n is what a byte does n bytes later."""
    first = []
    for byte in range(256):
        for _ in range(8):
            byte = (byte << 1 ^ (poly if byte & 0x80 else 0)) & 0xFF
        first.append(byte)
    slices = [first]
    while len(slices) < CRC_SLICES:
        slices.append([first[value] for value in slices[-1]])
    return slices


def _enum(prefix: str, names, values=None) -> str:
    items = ", ".join(f"{prefix}{n.upper()} = {v}" for n, v in zip(names, values or range(10**6)))
    return f"enum {{ {items} }};"


def _field_places(kind: Kind) -> list[str]:
    """Where the fields of a message stand among its raw values."""
    prefix, place, out = f"HOAP2_CAN_{kind.name.upper()}", 0, []
    for field in kind.fixed:
        out.append(f"{prefix}_{field.name.upper()} = {place}")
        place += field.repeat
    if kind.each:
        out += [f"{prefix}_FIXED = {place}", f"{prefix}_STRIDE = {len(kind.each)}"]
        out += [f"{prefix}_J_{field.name.upper()} = {i}" for i, field in enumerate(kind.each)]
    return out


def header(table: CanTable) -> str:
    raw = table.raw
    constants = {
        "SCHEMA": raw["schema"], "PROTOCOL": table.protocol, "BUSES": len(table.buses), "BOARDS": len(table.boards),
        "FRAMES": len(table.frames), "FIELDS": sum(len(f.placed) for f in table.frames),
        "MAX_FIELDS": max(len(f.placed) for f in table.frames), "MAX_LENGTH": max(f.length for f in table.frames),
        "BOARD_JOINTS": max(len(b.joints) for b in table.boards), "NODE_BITS": NODE_BITS,
        "NODES": 1 << NODE_BITS, "KINDS": len(table.kinds), "PARAMETERS": len(raw["parameter"]),
        "CONTROLLER_NODE": 0, "ALIVE_LIMIT_TICKS": raw["alive_limit_ticks"], "COUNTER_WINDOW": raw["counter_window"],
        "NOMINAL_BIT_S": raw["nominal_bit_s"], "DATA_BIT_S": raw["data_bit_s"],
    }  # fmt: skip
    out = [_enum("HOAP2_CAN_", constants, constants.values())]
    out.append(_enum("HOAP2_CAN_", ("unsigned", "signed", "float")))
    out.append(_enum("HOAP2_CAN_BUS_", table.buses))
    out.append(_enum("HOAP2_CAN_B_", [b.name for b in table.boards]))
    out.append(_enum("HOAP2_CAN_BOARD_", BOARD_KINDS))
    out.append(_enum("HOAP2_CAN_K_", [k.name for k in table.kinds]))
    for name, values in raw["enum"].items():
        out.append(_enum(f"HOAP2_CAN_{name.upper()}_", values))
    out.append(_enum("HOAP2_CAN_P_", [p["name"] for p in raw["parameter"]]))
    refusals = ["none", *raw["refusal"]]
    out.append("/* why a frame is refused */")
    out.append(_enum("HOAP2_CAN_REFUSED_", refusals))
    out.append(f"enum {{ HOAP2_CAN_REFUSALS = {len(refusals)} }};")
    out.append("/* places of a message's fields among its raw values; J: within the stride of a joint */")
    out += [f"enum {{ {', '.join(_field_places(k))} }};" for k in table.kinds]
    out.append(TYPES)
    out += ["extern const hoap2_can_field_t HOAP2_CAN_FIELD[HOAP2_CAN_FIELDS];",
            "extern const hoap2_can_layout_t HOAP2_CAN_LAYOUT[HOAP2_CAN_FRAMES];",
            "/* index of a layout, -1 for none: [bus][identifier] */",
            "extern const int8_t HOAP2_CAN_LOOKUP[HOAP2_CAN_BUSES][HOAP2_CAN_KINDS << HOAP2_CAN_NODE_BITS];",
            "extern const hoap2_can_board_data_t HOAP2_CAN_BOARD[HOAP2_CAN_BOARDS];",
            "extern const hoap2_can_servo_t HOAP2_CAN_SERVO[HOAP2_CAN_JOINTS];",
            "extern const hoap2_can_parameter_t HOAP2_CAN_PARAMETER[HOAP2_CAN_PARAMETERS];",
            f"extern const uint8_t HOAP2_CAN_CRC8[{CRC_SLICES}][256];"]  # fmt: skip
    body = "\n".join(out).replace("HOAP2_CAN_JOINTS]", f"{len(table.joint_names)}]")
    return (f"{BANNER}#ifndef HOAP2_CAN_GENERATED_CAN_TABLE_H\n#define HOAP2_CAN_GENERATED_CAN_TABLE_H\n"
            f'#include <stdint.h>\n\n#ifdef __cplusplus\nextern "C" {{\n#endif\n\n{body}\n\n'
            "#ifdef __cplusplus\n}\n#endif\n#endif\n")  # fmt: skip


def _field_row(placed) -> str:
    f = placed.field
    kind = "HOAP2_CAN_FLOAT" if f.real else "HOAP2_CAN_SIGNED" if f.signed else "HOAP2_CAN_UNSIGNED"
    low = "INT32_MIN" if f.low == -(1 << 31) else str(f.low)
    return (f"  {{{placed.first_bit}, {f.bits}, {kind}, {low}, {f.high}, {number(f.lsb)}, {number(1.0 / f.lsb)}}}, "
            f"/* {placed.name} */")  # fmt: skip


def _layout_row(frame: Frame, table: CanTable, first_field: int) -> str:
    board = table.boards.index(frame.board) if frame.board else -1
    sender = frame.board.node if frame.board and frame.sender == frame.board.name else 0
    return (f"  {{0x{frame.identifier:03X}, {first_field}, {frame.used_bits}, {frame.length}, {len(frame.placed)}, "
            f"{frame.bus}, HOAP2_CAN_K_{frame.kind.name.upper()}, {sender}, {board}, {frame.period_ticks}, "
            f"{frame.offset_ticks}}}, /* {table.buses[frame.bus]}: {frame.name} */")  # fmt: skip


def _lookup(table: CanTable) -> str:
    rows = []
    for bus in range(len(table.buses)):
        places = [-1] * (len(table.kinds) << NODE_BITS)
        for i, frame in enumerate(table.frames):
            if frame.bus == bus:
                places[frame.identifier] = i
        rows.append("  {" + ", ".join(map(str, places)) + "}")
    return ",\n".join(rows)


def source(table: CanTable) -> str:
    fields, layouts, first = [], [], 0
    for frame in table.frames:
        fields.append(f"  /* {table.buses[frame.bus]}: {frame.name} */")
        fields += [_field_row(p) for p in frame.placed]
        layouts.append(_layout_row(frame, table, first))
        first += len(frame.placed)
    boards = []
    for b in table.boards:
        joints = ", ".join(map(str, b.joints)) or "0"
        foot = int(b.kind == "foot" and b.name.startswith("l_"))
        boards.append(f"  {{{b.node}, {b.bus}, HOAP2_CAN_BOARD_{b.kind.upper()}, {foot}, {len(b.joints)}, "
                      f"{{{joints}}}}}, /* {b.name} */")  # fmt: skip
    robot = load_robot()
    inner, outer = robot["servo"]["velocity_loop_1_s"], robot["servo"]["position_loop_1_s"]
    gains = [(j["name"], j["armature_kgm2"] * inner * outer, j["armature_kgm2"] * inner) for j in robot["joints"]]
    servo = [f"  {{{number(kp)}, {number(kd)}}}, /* {name} */" for name, kp, kd in gains]
    parameters = []
    for p in table.raw["parameter"]:
        low, high = p.get("range", (0.0, 0.0))
        flags = f"{int('range' in p)}, {int('each' in p)}"
        parameters.append(f"  {{{number(low)}F, {number(high)}F, {flags}}}, /* {p['name']} */")
    crc = ",\n".join("  {" + ", ".join(map(str, s)) + "}" for s in crc_tables(table.raw["crc8_poly"]))
    tables = [
        ("hoap2_can_field_t HOAP2_CAN_FIELD[HOAP2_CAN_FIELDS]", "\n".join(fields)),
        ("hoap2_can_layout_t HOAP2_CAN_LAYOUT[HOAP2_CAN_FRAMES]", "\n".join(layouts)),
        ("int8_t HOAP2_CAN_LOOKUP[HOAP2_CAN_BUSES][HOAP2_CAN_KINDS << HOAP2_CAN_NODE_BITS]", _lookup(table)),
        ("hoap2_can_board_data_t HOAP2_CAN_BOARD[HOAP2_CAN_BOARDS]", "\n".join(boards)),
        (f"hoap2_can_servo_t HOAP2_CAN_SERVO[{len(table.joint_names)}]", "\n".join(servo)),
        ("hoap2_can_parameter_t HOAP2_CAN_PARAMETER[HOAP2_CAN_PARAMETERS]", "\n".join(parameters)),
        (f"uint8_t HOAP2_CAN_CRC8[{CRC_SLICES}][256]", crc),
    ]
    body = "\n\n".join(f"const {head} = {{\n{rows}\n}};" for head, rows in tables)
    return f'{BANNER}#include "can/generated/can_table.h"\n\n{body}\n'


def disturbances_header(table: CanTable) -> str:
    """The parameters of the modelled link as a C struct: reals first, then ints."""
    rows = sorted(table.disturbances, key=lambda d: d.kind != "real")
    types = {"real": "double", "int": "int32_t"}
    members = "\n".join(f"  {types[d.kind]} {d.name}; /* {d.text} [{d.unit}] */" for d in rows)
    checks = " &&\n         ".join(
        f"p->{d.name} >= {number(d.low) if d.kind == 'real' else int(d.low)} && "
        f"p->{d.name} <= {number(d.high) if d.kind == 'real' else int(d.high)}" for d in rows)
    defaults = "\n".join(
        f"  p->{d.name} = {number(d.default) if d.kind == 'real' else int(d.default)};" for d in rows)
    return (f"{BANNER}#ifndef HOAP2_LINK_GENERATED_DISTURBANCES_H\n#define HOAP2_LINK_GENERATED_DISTURBANCES_H\n"
            f"#include <stdint.h>\n\ntypedef struct {{\n{members}\n}} hoap2_link_params_t;\n\n"
            f"static inline void hoap2_link_params_defaults(hoap2_link_params_t *p) {{\n{defaults}\n}}\n\n"
            f"/* false for NaN too */\nstatic inline int hoap2_link_params_in_range(const hoap2_link_params_t *p) {{\n"
            f"  return {checks};\n}}\n\n#endif\n")  # fmt: skip
