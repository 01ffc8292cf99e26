"""Solves the problem with GetFEM; prints P, A, Q and the number of unknowns as JSON.

    getfem_slide.py ELEMENTS_PER_RADIUS INCREMENTS

Trilinear hexahedra, the volumetric part with one Gauss point; contact with a rigid obstacle by an
augmented Lagrangian, exactly Coulomb's law; MUMPS.
"""

import json
import sys

import getfem as gf
import numpy as np

import problem

MOST_ITERATIONS = 20
BASE, SYMMETRY, CONTACT = 1, 2, 3


def newton(model):
    """Solves the step; the number of iterations, or None.

    `Model.solve` compares its residual with forces that are not there: all loading is by displacement.
    """
    moving = model.interval_of_variable("u")
    for iteration in range(1, MOST_ITERATIONS + 1):
        model.assembly("build_all")
        change = gf.linsolve_mumps(model.tangent_matrix(), model.rhs()).ravel()
        model.to_variables(model.from_variables() + change)
        displacement = change[moving[0] : moving[0] + moving[1]]
        traction = np.delete(change, np.arange(moving[0], moving[0] + moving[1]))
        if abs(displacement).max() < 1e-5 * problem.DEPTH and abs(traction).max() < 1e-4 * problem.YIELD:
            return iteration
    return None


def main():
    gf.util_trace_level(0)
    elements, increments = map(int, sys.argv[1:])
    points, cells, top, base, symmetry = problem.half_hemisphere(elements)
    mesh = gf.Mesh("empty", 3)
    # GetFEM numbers the corners of a cube as binary numbers.
    corners = points[cells[:, [0, 1, 3, 2, 4, 5, 7, 6]]]
    mesh.add_convex(gf.GeoTrans("GT_QK(3,1)"), np.asfortranarray(corners.transpose(2, 1, 0)))

    at = mesh.pts()
    ids = np.asarray(mesh.pid())
    flat = np.hypot(at[0], at[1])
    on_top = np.abs(np.linalg.norm(at, axis=0) - problem.RADIUS) < 1e-9
    near = on_top & (flat < 1.6 * problem.CONTACT_RADIUS)
    mesh.set_region(BASE, mesh.faces_from_pid(ids[at[2] < 1e-12]))
    mesh.set_region(SYMMETRY, mesh.faces_from_pid(ids[at[1] < 1e-12]))
    mesh.set_region(CONTACT, mesh.faces_from_pid(ids[near]))

    cube = gf.Integ("IM_GAUSS_PARALLELEPIPED(3,2)")
    mim = gf.MeshIm(mesh, cube)
    mim_volume = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(3,1)"))
    every = gf.MeshFem(mesh, 3)
    every.set_fem(gf.Fem("FEM_QK(3,1)"))
    held = set(every.basic_dof_on_region(BASE))
    held |= {dof for dof in every.basic_dof_on_region(SYMMETRY) if dof % 3 == 1}
    mfu = gf.MeshFem("partial", every, np.array(sorted(set(range(every.nbdof())) - held)))
    tensors = gf.MeshImData(mim, -1, [3, 3])
    scalars = gf.MeshImData(mim, -1, 1)

    shear = problem.YOUNG / (2 * (1 + problem.POISSON))
    bulk = problem.YOUNG / (3 * (1 - 2 * problem.POISSON))
    model = gf.Model("real")
    model.add_fem_variable("u", mfu)
    model.add_fem_data("Previous_u", mfu)
    model.add_im_data("Epn", tensors)
    model.add_im_data("alphan", scalars)
    model.add_im_data("xi", scalars)
    model.add_im_data("Previous_xi", scalars)
    for name, value in {
        "lambda": -2 * shear / 3,
        "mu": shear,
        "bulk": bulk,
        "sigma_y": problem.YIELD,
        "H_k": 0.0,
        "H_i": problem.HARDENING,
        "friction": problem.FRICTION,
        "r": 5 * problem.CONTACT_MODULUS / (problem.CONTACT_RADIUS / elements),
        "flat": problem.RADIUS,
        "slide": 0.0,
    }.items():
        model.add_initialized_data(name, [value])
    law = ["Prandtl Reuss linear hardening", "displacement only", "u", "xi", "Epn", "alphan"]
    law += ["lambda", "mu", "sigma_y", "H_k", "H_i"]
    model.add_small_strain_elastoplasticity_brick(mim, *law)
    model.add_linear_term(mim_volume, "bulk*Trace(Grad_u)*Trace(Grad_Test_u)")

    model.add_filtered_fem_variable("traction", mfu, CONTACT)
    # The force on the body is `traction`; positive pressure pushes it along -z.
    friction = (
        "Coulomb_friction_coupled_projection(traction, [0;0;1],"
        " 0.1*(u - Previous_u - [slide;0;0]), flat - X(3) - u(3), friction, r)"
    )
    model.add_nonlinear_term(
        mim, f"-traction.Test_u - (1/r)*(traction - {friction}).Test_traction", CONTACT
    )
    print(json.dumps({"unknowns": int(model.nbdof())}), flush=True)

    def step(depth, slide, halvings=6):
        """One increment, or two of half its slide if it does not converge, and so on."""
        state = model.from_variables()
        model.set_variable("flat", [problem.RADIUS - depth])
        model.set_variable("slide", [slide])
        converged = newton(model)
        print(f"{depth:.3e} {slide:.3e}: {converged} iterations", file=sys.stderr, flush=True)
        if converged is None:
            model.to_variables(state)
            return halvings > 0 and all(step(depth, slide / 2, halvings - 1) for _ in range(2))
        model.small_strain_elastoplasticity_next_iter(mim, *law)
        model.set_variable("Previous_u", model.variable("u"))
        return True

    done = all(step(problem.DEPTH * (i / increments) ** 2, 0.0) for i in range(1, increments + 1))
    done = done and all(step(problem.DEPTH, problem.SLIDE * problem.DEPTH / increments) for _ in range(increments))

    force = gf.asm_generic(mim, 0, "traction", CONTACT, model)
    # Where the projection is pressure. The multiplier itself is its average on nodes, and swings about
    # nothing outside of the contact.
    pressed = "Heaviside(-traction(3) - r*(flat - X(3) - u(3)))"
    area = gf.asm_generic(mim, 0, pressed, CONTACT, model)
    print(
        json.dumps(
            {
                "finished": done,
                "P": 2 * abs(float(force[2])),
                "Q": 2 * abs(float(force[0])),
                "A": 2 * float(np.ravel(area)[0]),
            }
        )
    )


if __name__ == "__main__":
    main()
