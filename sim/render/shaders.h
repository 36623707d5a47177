// GLSL sources. Light is computed linearly; `display` maps it to the screen.
#ifndef HOAP2_RENDER_SHADERS_H
#define HOAP2_RENDER_SHADERS_H

#include <string>

namespace hoap2::shader {

inline const std::string kHeader = "#version 330 core\n";

// What robot, blocks and floor share.
inline const std::string kLight = R"(
uniform vec3 u_eye;
uniform vec3 u_light;        // towards the lamp
uniform mat4 u_shadow;       // world to shadow map, 0..1
uniform sampler2DShadow u_shadow_map;
uniform float u_shadow_on;

const vec3 HORIZON = vec3(0.855, 0.880, 0.905);

// Place in the shadow map, 0..1. Looking up a little off the surface, more where light grazes it,
// keeps it from shading itself.
vec3 in_shadow_map(vec3 p, vec3 n) {
  float slope = 1.0 - clamp(dot(n, u_light), 0.0, 1.0);
  return (u_shadow * vec4(p + n * (0.0008 + 0.0022 * slope), 1.0)).xyz - vec3(0.0, 0.0, 0.0004);
}

float off_middle(vec3 s) {
  vec2 from_middle = abs(s.xy - 0.5);
  return max(from_middle.x, from_middle.y);
}

// 1 in the light, 0 in the shadow: percentage-closer filter over 3x3 texels. Each of the four
// reads is itself a weighted mean of 2x2 comparisons.
float lamp_share(vec3 p, vec3 n) {
  if (u_shadow_on < 0.5) return 1.0;
  vec3 s = in_shadow_map(p, n);
  float inside = off_middle(s);
  if (inside > 0.495) return 1.0;
  const vec2 off = vec2(0.5, -0.5) * 1.25 / 1024.0;
  float sum = texture(u_shadow_map, vec3(s.xy + off.xx, s.z)) + texture(u_shadow_map, vec3(s.xy + off.xy, s.z)) +
              texture(u_shadow_map, vec3(s.xy + off.yx, s.z)) + texture(u_shadow_map, vec3(s.xy + off.yy, s.z));
  return mix(0.25 * sum, 1.0, smoothstep(0.45, 0.495, inside));
}

// The same with half of the reads, for ground whose grains hide the difference.
float lamp_share_on_grains(vec3 p, vec3 n) {
  if (u_shadow_on < 0.5) return 1.0;
  vec3 s = in_shadow_map(p, n);
  const vec2 off = vec2(0.5, -0.2) * 1.25 / 1024.0;
  float sum = texture(u_shadow_map, vec3(s.xy + off, s.z)) + texture(u_shadow_map, vec3(s.xy - off, s.z));
  return mix(0.5 * sum, 1.0, smoothstep(0.45, 0.495, off_middle(s)));
}

vec3 display(vec3 c) {
  // Shoulder at the top, so that white shells keep their shading.
  c = c * (1.0 + c * 0.10) / (1.0 + c * 0.42);
  return pow(clamp(c, 0.0, 1.0), vec3(1.0 / 2.2));
}
)";

inline const std::string kSolidVertex = R"(
layout(location = 0) in vec3 a_pos;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec3 a_albedo;
layout(location = 3) in vec2 a_gloss_link;
uniform vec4 u_pose[84];     // 28 poses, rows of [R | p]
uniform mat4 u_camera;
out vec3 v_pos;
out vec3 v_normal;
out vec3 v_albedo;
out float v_gloss;
void main() {
  int k = 3 * int(a_gloss_link.y + 0.5);
  vec4 p = vec4(a_pos, 1.0);
  v_pos = vec3(dot(u_pose[k], p), dot(u_pose[k + 1], p), dot(u_pose[k + 2], p));
  v_normal = vec3(dot(u_pose[k].xyz, a_normal), dot(u_pose[k + 1].xyz, a_normal), dot(u_pose[k + 2].xyz, a_normal));
  v_albedo = a_albedo;
  v_gloss = a_gloss_link.x;
  gl_Position = u_camera * vec4(v_pos, 1.0);
}
)";

inline const std::string kSolidFragment = R"(
in vec3 v_pos;
in vec3 v_normal;
in vec3 v_albedo;
in float v_gloss;
uniform vec4 u_floor;        // height over the floor = dot(u_floor, (p, 1))
out vec4 colour;
void main() {
  vec3 n = normalize(v_normal);
  vec3 v = normalize(u_eye - v_pos);
  float facing = dot(n, u_light);
  float lamp = facing > 0.0 ? facing * lamp_share(v_pos, n) : 0.0;
  // Light from the sky above and from the floor below, less of it close to the floor.
  float up = 0.5 + 0.5 * n.z;
  float open = mix(0.62, 1.0, smoothstep(0.0, 0.12, dot(u_floor, vec4(v_pos, 1.0))));
  vec3 around = mix(vec3(0.27, 0.26, 0.25), vec3(0.52, 0.56, 0.62), up) * open;
  vec3 c = v_albedo * (around + vec3(1.00, 0.96, 0.90) * lamp * 0.98);
  float rim = pow(1.0 - clamp(dot(n, v), 0.0, 1.0), 4.0);
  vec3 h = normalize(v + u_light);
  float shine = pow(clamp(dot(n, h), 0.0, 1.0), mix(12.0, 90.0, v_gloss)) * lamp;
  float fresnel = 0.04 + 0.5 * v_gloss * rim;
  c += vec3(shine * v_gloss * 0.55) + fresnel * mix(vec3(0.30), vec3(0.60, 0.66, 0.74), up) * open;
  colour = vec4(display(c), 1.0);
}
)";

inline const std::string kShadowFragment = R"(
void main() {}
)";

inline const std::string kFloorVertex = R"(
layout(location = 0) in vec3 a_pos;
uniform mat4 u_camera;
out vec3 v_pos;
void main() {
  v_pos = a_pos;
  gl_Position = u_camera * vec4(a_pos, 1.0);
}
)";

// Tiles of 100 mm with joints, half tiles with finer ones, a stronger line each metre.
inline const std::string kFloorFragment = R"(
in vec3 v_pos;
uniform vec3 u_floor_normal;

uniform float u_fade_m;
out vec4 colour;
float line(vec2 p, float pitch, float half_width) {
  vec2 q = p / pitch;
  vec2 w = max(fwidth(q), 1e-6);
  vec2 d = abs(fract(q - 0.5) - 0.5);
  vec2 a = 1.0 - smoothstep(half_width / pitch - 0.5 * w, half_width / pitch + 0.9 * w, d);
  // A line thinner than a pixel turns into a tint instead of a moire.
  a *= clamp(2.0 * half_width / pitch / w, 0.0, 1.0) * (1.0 - smoothstep(0.25, 0.6, w));
  return max(a.x, a.y);
}
void main() {
  vec2 p = v_pos.xy;
  vec2 q = p / 0.1;
  vec2 w = max(fwidth(q), 1e-6);
  // Checker, filtered over the pixel's footprint.
  vec2 tri = 2.0 * (abs(fract((q - 0.5 * w) * 0.5) - 0.5) - abs(fract((q + 0.5 * w) * 0.5) - 0.5)) / w;
  float checker = 0.5 - 0.5 * clamp(tri.x, -1.0, 1.0) * clamp(tri.y, -1.0, 1.0);
  vec3 albedo = mix(vec3(0.545, 0.560, 0.575), vec3(0.600, 0.612, 0.622), checker);
  albedo *= 1.0 - 0.10 * line(p, 0.05, 0.0005);
  albedo *= 1.0 - 0.22 * line(p, 0.10, 0.0009);
  albedo *= 1.0 - 0.35 * line(p, 1.00, 0.0022);
  vec3 n = u_floor_normal;
  float lamp = clamp(dot(n, u_light), 0.0, 1.0);
  float share = lamp_share(v_pos, n);
  vec3 c = albedo * (vec3(0.43, 0.46, 0.51) + vec3(1.00, 0.96, 0.90) * lamp * share * 0.92);
  float fade = smoothstep(0.25 * u_fade_m, u_fade_m, length(v_pos.xy - u_eye.xy));
  colour = vec4(mix(display(c), HORIZON, fade), 1.0);
}
)";

inline const std::string kSoilVertex = R"(
layout(location = 0) in vec3 a_pos;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_change_open;
uniform vec4 u_pool[3];      // rows of [R | p]
uniform mat4 u_camera;
out vec3 v_pos;
out vec3 v_normal;
out vec3 v_grain;            // place in the pool, change of the surface
out float v_open;
void main() {
  vec4 p = vec4(a_pos, 1.0);
  v_pos = vec3(dot(u_pool[0], p), dot(u_pool[1], p), dot(u_pool[2], p));
  v_normal = vec3(dot(u_pool[0].xyz, a_normal), dot(u_pool[1].xyz, a_normal), dot(u_pool[2].xyz, a_normal));
  v_grain = vec3(a_pos.xy, a_change_open.x);
  v_open = a_change_open.y;
  gl_Position = u_camera * vec4(v_pos, 1.0);
}
)";

// Sand with grains, tinted by how far it is sunk or raised.
inline const std::string kSoilFragment = R"(
in vec3 v_pos;
in vec3 v_normal;
in vec3 v_grain;
in float v_open;
uniform vec3 u_tint[5];      // full sinkage, half, untouched, half raised, fully raised
uniform vec2 u_per_m;        // steps of u_tint a metre of sinkage and of rise
out vec4 colour;
float hash(ivec2 i) {
  uint h = uint(i.x) * 374761393u + uint(i.y) * 668265263u;
  h = (h ^ (h >> 13u)) * 1274126177u;
  return float((h ^ (h >> 16u)) & 0xffffu) / 65535.0;
}
// Smooth noise about 0.5 that fades where it is finer than a pixel.
float noise(vec2 p) {
  ivec2 i = ivec2(floor(p));
  vec2 f = fract(p);
  vec2 w = fwidth(p);
  f = f * f * (3.0 - 2.0 * f);
  float n = mix(mix(hash(i), hash(i + ivec2(1, 0)), f.x), mix(hash(i + ivec2(0, 1)), hash(i + ivec2(1, 1)), f.x), f.y);
  return mix(n, 0.5, smoothstep(0.4, 1.2, max(w.x, w.y)));
}
void main() {
  float t = clamp(2.0 + v_grain.z * (v_grain.z < 0.0 ? u_per_m.x : u_per_m.y), 0.0, 4.0);
  int k = min(int(t), 3);
  vec3 albedo = mix(u_tint[k], u_tint[k + 1], t - float(k));
  albedo *= v_open;
  albedo *= 1.0 + 0.30 * (noise(v_grain.xy * 900.0) - 0.5) + 0.14 * (noise(v_grain.xy * 110.0) - 0.5);
  vec3 n = normalize(v_normal);
  float lamp = clamp(dot(n, u_light), 0.0, 1.0);
  float share = lamp_share_on_grains(v_pos, n);
  vec3 c = albedo * (vec3(0.43, 0.46, 0.51) * (0.4 + 0.6 * n.z) + vec3(1.00, 0.96, 0.90) * lamp * share * 0.92);
  colour = vec4(display(c), 1.0);
}
)";

inline const std::string kSkyVertex = R"(
layout(location = 0) in vec3 a_pos;
out vec2 v_ndc;
void main() {
  v_ndc = a_pos.xy;
  gl_Position = vec4(a_pos.xy, 1.0, 1.0);   // at the far plane
}
)";

inline const std::string kSkyFragment = R"(
in vec2 v_ndc;
uniform vec3 u_ray_z;        // height of the line of sight: x per ndc x, y per ndc y, z in the middle
out vec4 colour;
void main() {
  float up = dot(u_ray_z, vec3(v_ndc, 1.0));
  vec3 c = mix(HORIZON, vec3(0.520, 0.640, 0.770), smoothstep(0.0, 0.55, up));
  colour = vec4(c, 1.0);
}
)";

// Marks: their own colour, slightly shaded by their normal.
inline const std::string kMarkVertex = R"(
layout(location = 0) in vec3 a_pos;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec4 a_colour;
uniform mat4 u_camera;
out vec3 v_normal;
out vec4 v_colour;
void main() {
  v_normal = a_normal;
  v_colour = a_colour;
  gl_Position = u_camera * vec4(a_pos, 1.0);
}
)";

inline const std::string kMarkFragment = R"(
in vec3 v_normal;
in vec4 v_colour;
uniform vec3 u_light;
uniform float u_alpha;
out vec4 colour;
void main() {
  float shade = 0.80 + 0.20 * dot(normalize(v_normal), u_light);
  colour = vec4(v_colour.rgb * shade, v_colour.a * u_alpha);
}
)";

}  // namespace hoap2::shader
#endif
