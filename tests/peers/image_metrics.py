#!/usr/bin/env python3
"""Measures of `sparrow compare` against NVIDIA's flip-evaluator and scikit-image.

    cargo build --release
    pip install flip-evaluator scikit-image numpy       # 1.7 and 0.26
    python3 tests/peers/image_metrics.py [PICTURE REFERENCE]... [--sparrow target/release/sparrow]

Ten pairs are made by arithmetic: noise, blur, shifts, gains, fireflies, of low and high dynamic range. Pairs of files (PFM or
PNG; EXR where the module OpenEXR is there) are compared besides. A row gives the largest differences of the means of FLIP and
HDR-FLIP, of SSIM, and of PSNR in dB. The exit code is 1 where any exceeds 1e-4.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import flip_evaluator
import numpy as np
from skimage.metrics import peak_signal_noise_ratio, structural_similarity

LIMIT = 1e-4


def write_pfm(path, rgb):
    height, width, _ = rgb.shape
    path.write_bytes(f"PF\n{width} {height}\n-1\n".encode() + rgb[::-1].astype("<f4").tobytes())


def read(path):
    if path.suffix == ".exr":
        import OpenEXR

        channels = OpenEXR.File(str(path)).channels()
        pixels = channels["RGB"].pixels if "RGB" in channels else np.stack([channels[c].pixels for c in "RGB"], -1)
        return pixels[..., :3].astype(np.float32)
    if path.suffix == ".pfm":
        head, size, scale, data = path.read_bytes().split(b"\n", 3)
        width, height = map(int, size.split())
        return np.frombuffer(data, "<f4").reshape(height, width, 3)[::-1].copy()
    from skimage.io import imread

    v = imread(path)[..., :3] / 255
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4).astype(np.float32)


def srgb(linear):
    v = np.clip(linear.astype(np.float64), 0, 1)
    return np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)


def blurred(rgb):
    return sum(np.roll(rgb, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1)) / 9


def made_pairs():
    """Name, picture, reference."""
    rng = np.random.default_rng(7)
    y, x = np.mgrid[:180, :240]
    waves = np.stack([0.5 + 0.45 * np.sin(x / 9 + y / 5), 0.5 + 0.45 * np.cos(x * y / 900), 0.1 + 0.8 * ((x // 12 + y // 12) % 2)], -1)
    ramp = np.stack([x / 240, y / 180, (x + y) / 420], -1)
    dark = 0.02 * waves
    lamps = waves**4 + 200 * np.exp(-((x - 60) ** 2 + (y - 50) ** 2) / 60)[..., None] * [1, 0.8, 0.5]
    wide = np.exp(8 * ramp - 4)
    flies = lamps.copy()
    flies[rng.integers(0, 180, 40), rng.integers(0, 240, 40)] += 500
    noise = lambda v, s: np.abs(v * np.exp(rng.normal(0, s, v.shape)))
    pairs = [
        ("noise", np.clip(waves + rng.normal(0, 0.05, waves.shape), 0, 1), waves),
        ("blur", blurred(waves), waves),
        ("shift", np.roll(waves, 1, 1), waves),
        ("gain", 1.03 * ramp, ramp),
        ("hue", ramp[..., ::-1], ramp),
        ("dark noise", noise(dark, 0.3), dark),
        ("lamps, noise", noise(lamps, 0.2), lamps),
        ("lamps, fireflies", flies, lamps),
        ("wide, gain", 0.9 * wide, wide),
        ("wide, noise", noise(wide, 0.5), wide),
    ]
    return [(name, p.astype(np.float32), r.astype(np.float32)) for name, p, r in pairs]


def theirs(picture, reference):
    flip = lambda a, b, mode, **more: flip_evaluator.evaluate(b, a, mode, applyMagma=False, **more)[0].mean(dtype=np.float64)
    shown = [np.clip(v, 0, 1) for v in (picture, reference)]
    a, b = srgb(picture), srgb(reference)
    similarity = structural_similarity(a, b, data_range=1, channel_axis=-1, gaussian_weights=True, sigma=1.5, use_sample_covariance=False)
    return {
        "flip": flip(*shown, "LDR", inputsRGB=False),
        "flip-hdr": flip(np.maximum(picture, 0), np.maximum(reference, 0), "HDR"),
        "ssim": similarity,
        "psnr": peak_signal_noise_ratio(b, a, data_range=1),
    }


def ours(sparrow, picture, reference, names):
    words = [w for n in names for w in ("--metric", n)]
    run = subprocess.run([sparrow, "compare", picture, reference, "--json", *words], capture_output=True, text=True)
    if run.returncode:
        sys.exit(f"{picture} {reference}: {run.stderr}")
    return json.loads(run.stdout)["metrics"]


def main():
    args = argparse.ArgumentParser()
    args.add_argument("files", nargs="*", type=Path)
    args.add_argument("--sparrow", default="target/release/sparrow")
    args = args.parse_args()
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        jobs = []
        for i, (name, p, r) in enumerate(made_pairs()):
            paths = [Path(folder, f"{i}{side}.pfm") for side in "pr"]
            write_pfm(paths[0], p), write_pfm(paths[1], r)
            jobs.append((name, *paths))
        jobs += [(f"{p.stem} {r.stem}", p, r) for p, r in zip(args.files[::2], args.files[1::2])]
        for name, p, r in jobs:
            want = theirs(read(p), read(r))
            got = ours(args.sparrow, p, r, want)
            off = {k: abs(got[k] - want[k]) for k in want}
            ok = max(off.values()) <= LIMIT
            failed |= not ok
            row = "   ".join(f"{k} {got[k]:9.6f} ({off[k]:.0e})" for k in want)
            print(f"{name:24} {row}   {'agree' if ok else 'DIFFER'}", flush=True)
    sys.exit(failed)


if __name__ == "__main__":
    main()
