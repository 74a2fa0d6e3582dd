#!/usr/bin/env python3
"""Reflection models against Mitsuba 3, on the same directions: values, densities, and time.

    cargo build --release -p sparrow-models --example columns
    pip install mitsuba numpy            # 3.9; its LLVM variants need libLLVM
    python3 tests/peers/mitsuba_models.py [--time] [--columns target/release/examples/columns]

For each case 10^4 random pairs of directions are evaluated by both. A row gives the largest relative difference of `f cos` and
of the density among pairs where either is above 1e-4 of its largest value, and how many pairs differ by more than 1e-4.
With --time, 10^6 pairs on one thread: nanoseconds per pair of ours (eight lanes, four wavelengths) and of Mitsuba's
`llvm_ad_rgb` (three channels), and the ratio of theirs to ours. The exit code is 1 where a case that should agree does not.
"""
import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import drjit as dr
import mitsuba as mi
import numpy as np

COPPER = dict(eta=0.27, k=3.41)
CORRELATED = "masking: ours correlates heights, Mitsuba's multiplies both sides"
FITTED = "masking: Mitsuba's is Walter's rational fit to Beckmann's, good to 3e-3"
ROUNDED = "rounding, in pairs close to the critical angle"
SEPARABLE = "masking=separable"


def conductor(ndf, ax, ay):
    return {"type": "roughconductor", "distribution": ndf, "alpha_u": ax, "alpha_v": ay, **COPPER}


def dielectric(ndf, a):
    return {"type": "roughdielectric", "distribution": ndf, "alpha": a, "int_ior": 1.5, "ext_ior": 1.0}


WIDTHS = [(0.1, 0.1), (0.5, 0.5), (0.05, 0.3)]
# Name, our model with its parameters, Mitsuba's, and why they differ (None: they are the same).
CASES = [("diffuse", ["lambert", "reflectance=0.5"], {"type": "diffuse", "reflectance": 0.5}, None)]
for ndf, why in (("ggx", None), ("beckmann", FITTED)):
    for ax, ay in WIDTHS:
        words = ["microfacet_reflection", f"ndf={ndf}", SEPARABLE, "fresnel=conductor"]
        words += [f"alpha_x={ax}", f"alpha_y={ay}", "eta=0.27", "k=3.41"]
        CASES.append((f"roughconductor {ndf} {ax} {ay}", words, conductor(ndf, ax, ay), why))
    for a in (0.1, 0.5):
        words = ["microfacet_dielectric", f"ndf={ndf}", SEPARABLE, f"alpha_x={a}", f"alpha_y={a}", "eta=1.5"]
        CASES.append((f"roughdielectric {ndf} {a}", words, dielectric(ndf, a), why or (ROUNDED if a > 0.3 else None)))
words = ["conductor", "alpha_x=0.3", "alpha_y=0.3", "eta=0.27", "k=3.41"]
CASES.append(("conductor against roughconductor", words, conductor("ggx", 0.3, 0.3), CORRELATED))
words = ["dielectric", "alpha_x=0.3", "alpha_y=0.3", "eta=1.5"]
CASES.append(("dielectric against roughdielectric", words, dielectric("ggx", 0.3), CORRELATED))


def directions(n, rng, below):
    """n unit vectors, as columns; a share `below` of them under the surface."""
    z = rng.uniform(0.02, 1, n)
    phi = rng.uniform(0, 2 * np.pi, n)
    r = np.sqrt(1 - z * z)
    z = np.where(rng.uniform(size=n) < below, -z, z)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z]).astype(np.float32)


def ours(columns, words, inputs, repeat=1):
    with tempfile.TemporaryDirectory() as d:
        source, result = Path(d, "in"), Path(d, "out")
        source.write_bytes(inputs.astype("<f4").tobytes())
        run = subprocess.run([columns, *words, source, result, str(repeat)], capture_output=True, text=True)
        if run.returncode:
            sys.exit(f"{' '.join(words)}: {run.stderr}")
        out = np.fromfile(result, "<f4").reshape(7, -1)
        return out[0], out[1], [float(x) for x in run.stdout.split()]


def interaction(wo):
    si = dr.zeros(mi.SurfaceInteraction3f, wo.shape[1])
    si.wi = mi.Vector3f(*[mi.Float(c) for c in wo])
    dr.eval(si)
    return si


def theirs(bsdf, inputs):
    si = interaction(inputs[:3])
    wi = mi.Vector3f(*[mi.Float(c) for c in inputs[3:6]])
    value, pdf = bsdf.eval_pdf(mi.BSDFContext(), si, wi)
    return np.array(value)[0], np.array(pdf)


def their_time(bsdf, inputs, repeat):
    si = interaction(inputs[:3])
    wi = mi.Vector3f(*[mi.Float(c) for c in inputs[3:6]])
    u = [mi.Float(c) for c in inputs[6:9]]
    dr.eval(wi, u)
    ctx = mi.BSDFContext()

    def best(f):
        shortest = np.inf
        for _ in range(repeat + 2):  # the first runs compile
            dr.sync_thread()
            start = time.perf_counter()
            dr.eval(f())
            dr.sync_thread()
            shortest = min(shortest, time.perf_counter() - start)
        return shortest * 1e9 / inputs.shape[1]

    sampled = lambda: (lambda s, w: (s.wo, s.pdf, s.eta, w))(*bsdf.sample(ctx, si, u[0], mi.Point2f(u[1], u[2])))
    return best(lambda: bsdf.eval_pdf(ctx, si, wi)), best(sampled)


def difference(a, b):
    """Largest relative difference where either counts, and the share of pairs that differ by more than 1e-4."""
    size = np.maximum(abs(a), abs(b))
    counts = size > 1e-4 * size.max()
    d = abs(a - b)[counts] / size[counts]
    return d.max(), (d > 1e-4).sum()


def main():
    args = argparse.ArgumentParser()
    args.add_argument("--time", action="store_true")
    args.add_argument("--columns", default="target/release/examples/columns")
    args = args.parse_args()
    mi.set_variant("llvm_ad_rgb")
    dr.set_thread_count(1)
    rng = np.random.default_rng(1)
    n = 1_000_000 if args.time else 10_000
    inputs = np.concatenate([directions(n, rng, 0.3), directions(n, rng, 0.3), rng.uniform(size=(3, n)).astype(np.float32)])
    # A quarter of the lights close to the mirror direction, where narrow lobes are.
    near = slice(0, n // 4)
    v = inputs[:3, near] * np.float32([[-1], [-1], [1]]) + rng.normal(size=(3, n // 4)).astype(np.float32) * 0.1
    inputs[3:6, near] = v / np.linalg.norm(v, axis=0)
    failed = False
    for name, words, theirs_is, why in CASES:
        bsdf = mi.load_dict(theirs_is)
        inside = "dielectric" in name
        x = inputs.copy()
        if not inside:
            # Mitsuba's opaque models are black from below.
            x[2], x[5] = abs(x[2]), abs(x[5])
        f, pdf, times = ours(args.columns, words, x, 5 if args.time else 1)
        if args.time:
            t = their_time(bsdf, x, 5)
            print(f"{name:36} f+pdf {times[0]:6.2f} ns, {t[0] / times[0]:5.2f} x   sample {times[1]:6.2f} ns, {t[1] / times[1]:5.2f} x")
            continue
        g, q = theirs(bsdf, x)
        (df, nf), (dp, np_) = difference(f, g), difference(pdf, q)
        ok = nf + np_ == 0
        failed |= not ok and why is None
        print(f"{name:36} f cos {df:.1e} ({nf})   density {dp:.1e} ({np_})   {'agree' if ok else why or 'DIFFER'}")
    sys.exit(failed)


if __name__ == "__main__":
    main()
