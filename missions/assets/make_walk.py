"""Draws walk-1.svg ... walk-6.svg beside this file: two steps of a walking figure, for missions/svg-walk.toml.

Every frame has the same shapes with the same ids and the same viewBox, as an animation needs them.
"""
import math
from pathlib import Path

FRAMES = 6
NECK, HIP = (50.0, 25.0), (50.0, 56.0)
THIGH, SHANK, UPPER_ARM, FOREARM = 19.0, 19.0, 14.0, 13.0
LEFT, RIGHT = "#ffb74d", "#4fc3f7"


def from_joint(start, length, angle_deg):
    """The end of a limb that hangs down at 0 and swings to the right with positive angles."""
    angle = math.radians(angle_deg)
    return start[0] + length * math.sin(angle), start[1] + length * math.cos(angle)


def limb(name, colour, start, upper, lower, swing, bend):
    middle = from_joint(start, upper, swing)
    end = from_joint(middle, lower, swing + bend)
    points = " ".join(f"{x:.2f},{y:.2f}" for x, y in (start, middle, end))
    return f'  <polyline id="{name}" points="{points}" stroke="{colour}"/>'


def side(name, colour, sign, raised, swung, bob):
    """The leg and the arm of one side (sign -1: left), seen from the front: a knee and the other arm rise together."""
    hip, shoulder = (HIP[0] + 5.0 * sign, HIP[1] + 2.0 + bob), (NECK[0] + 7.0 * sign, NECK[1] + 5.0 + bob)
    return [
        limb(f"{name}-leg", colour, hip, THIGH, SHANK, sign * (8.0 + 42.0 * raised), -sign * (4.0 + 52.0 * raised)),
        limb(f"{name}-arm", colour, shoulder, UPPER_ARM, FOREARM, sign * (20.0 + 30.0 * swung), sign * (8.0 + 60.0 * swung)),
    ]


def frame(share):
    """`share` of two steps."""
    phase = 2.0 * math.pi * share
    left, right, bob = max(0.0, math.sin(phase)), max(0.0, -math.sin(phase)), 1.2 * math.cos(2.0 * phase)
    return "\n".join([
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="5 5 90 96">',
        '  <g fill="none" stroke-width="2">',
        *side("left", LEFT, -1.0, left, right, bob),
        *side("right", RIGHT, 1.0, right, left, bob),
        f'  <path id="body" d="M{NECK[0]} {NECK[1] + 4.0 + bob:.2f}V{HIP[1] + bob:.2f}" stroke="#ffffff"/>',
        "  </g>",
        f'  <circle id="head" cx="50" cy="{16.0 + bob:.2f}" r="8" fill="#ffe0b2"/>',
        "</svg>", ""])


if __name__ == "__main__":
    for k in range(FRAMES):
        Path(__file__).with_name(f"walk-{k + 1}.svg").write_text(frame(k / FRAMES), encoding="utf-8")
