"""Draws walk-1.svg ... walk-6.svg beside this file: one step of a walking figure, for missions/svg-walk.toml.

Every frame has the same shapes with the same ids and the same viewBox, as an animation needs them.
"""
import math
from pathlib import Path

FRAMES = 6
HIP, NECK = (50.0, 58.0), (50.0, 25.0)
FAR_HIP, NEAR_HIP, FAR_SHOULDER, NEAR_SHOULDER = (54.0, 60.0), (46.0, 60.0), (58.0, 32.0), (42.0, 32.0)
THIGH, SHANK, UPPER_ARM, FOREARM = 19.0, 19.0, 14.0, 13.0


def from_joint(start, length, angle_deg):
    """The end of a limb that hangs down at 0 and swings forward (to the right) with positive angles."""
    angle = math.radians(angle_deg)
    return start[0] + length * math.sin(angle), start[1] + length * math.cos(angle)


def limb(name, colour, start, upper, lower, swing, bend):
    middle = from_joint(start, upper, swing)
    end = from_joint(middle, lower, swing + bend)
    points = " ".join(f"{x:.2f},{y:.2f}" for x, y in (start, middle, end))
    return f'  <polyline id="{name}" points="{points}" stroke="{colour}"/>'


def frame(share):
    """`share` of a whole stride."""
    phase = 2.0 * math.pi * share
    stride, bob = math.sin(phase), 1.2 * math.cos(2.0 * phase)
    bend = lambda p: -22.0 - 20.0 * math.cos(p)  # the leg that comes forward is bent most
    lifted = lambda p: (p[0], p[1] + bob)
    return "\n".join([
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="10 5 80 96">',
        '  <g fill="none" stroke-width="3">',
        limb("far-arm", "#2a7fb8", lifted(FAR_SHOULDER), UPPER_ARM, FOREARM, 32.0 * stride, 25.0),
        limb("far-leg", "#2a7fb8", lifted(FAR_HIP), THIGH, SHANK, -28.0 * stride, bend(phase + math.pi)),
        f'  <path id="body" d="M{NECK[0]} {NECK[1] + bob:.2f}V{HIP[1] + bob:.2f}" stroke="#ffffff"/>',
        limb("near-leg", "#ffb74d", lifted(NEAR_HIP), THIGH, SHANK, 28.0 * stride, bend(phase)),
        limb("near-arm", "#ffb74d", lifted(NEAR_SHOULDER), UPPER_ARM, FOREARM, -32.0 * stride, 25.0),
        "  </g>",
        f'  <circle id="head" cx="51" cy="{17 + bob:.2f}" r="8" fill="#ffe0b2"/>',
        "</svg>", ""])


if __name__ == "__main__":
    for k in range(FRAMES):
        Path(__file__).with_name(f"walk-{k + 1}.svg").write_text(frame((k + 0.5) / FRAMES), encoding="utf-8")
