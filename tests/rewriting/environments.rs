//! Environments: interpretations change them in the order of the chains, and rules read them as the last pass has left them.

use super::scripts::{all_chains, chain, divided, error, run, run_with};

const PLANTS: &str = r#"
local ground = discs({ overlap = 0.5 })
local Seed, Plant, Dead = module("Seed", "x"), module("Plant", "x", "r"), module("Dead", "x")
local field = lsystem({ object = turtle(), environment = ground })
"#;

#[test]
fn rules_read_an_environment_as_the_last_pass_has_left_it() {
    // The plants at 0 and 1 overlap once their radii add to more than 2: the later one of equal ones dies.
    let script = format!(
        "{PLANTS}field:axiom(Plant(0, 0.4), Plant(1, 0.4), Plant(9, 0.4))
        field:rule('Plant(x, r)', function(this, x, r)
          if ground:dominated(vec(x, 0, 0)) then return Dead(x) end
          return Plant(x, r * 2)
        end)
        field:interpret('Plant(x, r)', function(this, x, r) ground:add(vec(x, 0, 0), r) end)
        for steps = 0, 3 do field:derive(steps) end\n"
    );
    let run = run(&script);
    let chains: Vec<String> =
        run.systems.iter().map(|system| system.chain_text().trim().to_owned()).collect();
    assert_eq!(
        chains,
        [
            "Plant(0,0.4) Plant(1,0.4) Plant(9,0.4)",
            "Plant(0,0.8) Plant(1,0.8) Plant(9,0.8)",
            "Plant(0,1.6) Plant(1,1.6) Plant(9,1.6)",
            "Plant(0,3.2) Dead(1) Plant(9,3.2)",
        ]
    );
}

#[test]
fn interpretations_read_what_the_modules_before_them_have_changed() {
    let made = chain(
        "local light = shadow_voxels({ size = 1, strength = 0.25, decay = 1, depth = 3 })
        local A, B, Seen = module('A'), module('B', 'n'), module('Seen', 'light')
        local variable = variables({ first = -1, second = -1 })
        local s = lsystem({ object = turtle(), environment = { light }, variables = variable })
        s:axiom(F(0.1), A(), A())
        s:interpret('A', function(this)
          if variable.first < 0 then variable.first = light:light(vec(0, 0, 0))
          elseif variable.second < 0 then variable.second = light:light(vec(0, 0, 0)) end
          light:shade(this:position(), 2)
        end)
        s:rule('A', function(this) return Seen(light:light(vec(0, 0, 0))) end)
        s:after_step(function() expect(variable.first, 1) expect(variable.second, 0.75) end)
        s:derive(1)\n",
    );
    // Both shade the voxel by 0.25 * 2; one such shadow of amount 1 does not count.
    assert_eq!(made, "F(0.1) Seen(0.25) Seen(0.25)");
}

#[test]
fn chains_share_an_environment_and_give_the_same_for_any_number_of_threads() {
    let script = "local points = {}
        for i = 1, 300 do points[i] = vec(random(-4, 4), random(-4, 4), random(1, 6)) end
        local space = attractors({ points = points, influence = 3, kill = 0.5 })
        local light = shadow_voxels({ size = 0.5 })
        local Root, Node, Grow = module('Root', 'x'), module('Node'), module('Grow', 'x', 'y', 'z')
        local trees = lsystem({ object = turtle({ sides = 3 }), environment = { space, light } })
        trees:axiom(source({ -2, 0, 2 }), function(x) return Root(x), Node() end)
        trees:rule('Node', { when = function(this) return light:light(this:position()) > 0.2 end }, function(this)
          local place = this:position()
          if space:count(place) > 0 then
            local to = space:direction(place)
            return Node(), { Grow(to.x, to.y, to.z + 0.1 * random()), Node() }
          end
        end)
        trees:interpret('Root(x)', function(this, x) this:jump(vec(x, 0, 0)) end)
        trees:interpret('Node', function(this) space:add(this:position()) light:shade(this:position(), 0.1) end)
        trees:interpret('Grow(x, y, z)', function(this, x, y, z) this:face(vec(x, y, z)):forward(0.4) end)
        trees:derive(12)\n";
    let of = |threads, batch| all_chains(&run_with(script, divided(threads, batch)));
    let one = of(1, 4096);
    assert!(one.matches("Grow").count() > 100, "{}", one.matches("Grow").count());
    for (threads, batch) in [(1, 2), (2, 3), (3, 4096), (3, 1)] {
        assert_eq!(of(threads, batch), one);
    }
}

#[test]
fn each_derivation_begins_with_the_environment_that_the_script_has_made() {
    let run = run("local points = {}
        for i = 1, 40 do points[i] = vec(0, 0, i * 0.2) end
        local space = attractors({ points = points, influence = 2, kill = 0.3 })
        local Node, Left = module('Node'), module('Left', 'n')
        local tree = lsystem({ object = turtle(), environment = space })
        tree:axiom(Node())
        tree:rule('Node', function(this)
          return space:count(this:position()) > 0 and F(0.4) or Left(space:remaining()), Node()
        end)
        tree:interpret('Node', function(this) space:add(this:position()) end)
        tree:derive(30)
        tree:derive(30)\n");
    let chains: Vec<String> = run.systems.iter().map(|system| system.chain_text()).collect();
    assert_eq!(chains[0], chains[1]);
    assert!(chains[0].contains("F(0.4) F(0.4) F(0.4)"), "{}", chains[0]);
}

#[test]
fn roots_share_the_water_in_the_order_of_the_chains() {
    // A cell holds 4: the first root takes 3 of it, the second one the rest. A root in another cell takes 3.
    let script = "local ground = soil({ size = { 2, 1, 1 }, cell = 1, amount = 4 })
        local At, Root, Got = module('At', 'x', 'z'), module('Root'), module('Got', 'taken', 'left')
        local s = lsystem({ object = turtle(), environment = ground })
        s:axiom(source({ -0.5, -0.6, 0.5 }), function(x) return At(x, -0.5), Root() end)
        s:interpret('At(x, z)', function(this, x, z) this:jump(vec(x, 0, z)) end)
        s:interpret('Root', function(this) ground:take(this:position(), 0, 3) end)
        s:rule('Root', function(this)
          return Got(ground:taken(this:position()), ground:amount(this:position()))
        end)
        s:derive(1)\n";
    for threads in [1, 3] {
        let made = all_chains(&run_with(script, divided(threads, 1)));
        let expected = ["At(-0.5,-0.5) Got(3,0)", "At(-0.6,-0.5) Got(1,0)", "At(0.5,-0.5) Got(3,1)"];
        assert_eq!(made.split_whitespace().collect::<Vec<_>>().join(" "), expected.join(" "));
    }
}

#[test]
fn water_that_is_taken_does_not_return_in_the_next_pass_but_in_the_next_derivation() {
    let run = run("local ground = soil({ size = { 3, 1, 1 }, cell = 1, amount = 10, diffusion = 1000 })
        local Root, Left = module('Root'), module('Left', 'water')
        local s = lsystem({ object = turtle(), environment = ground })
        s:axiom(Pitch(180), G(0.5), Root(), Left(30))
        s:interpret('Root', function(this) ground:take(this:position(), 0, 6) end)
        s:rule('Left(water)', function(this, water) return Left(math.round(ground:total())) end)
        s:derive(1)
        s:derive(3)\n");
    let chains: Vec<String> =
        run.systems.iter().map(|system| system.chain_text().trim().to_owned()).collect();
    // Diffusion leaves nearly the same in each of the three cells: 8, then 6, then 4.
    assert!(chains[0].ends_with("Root Left(24)") && chains[1].ends_with("Root Left(12)"), "{chains:?}");
}

#[test]
fn rules_and_the_top_level_read_obstacles_with_or_without_the_option() {
    let script = |option: &str| {
        format!(
            "local Part = module('Part')
            local post = lsystem({{ object = extruder({{ sides = 4 }}) }})
            post:axiom(Part())
            post:interpret('Part', function(this) this:extrude(2) end)
            local ground = obstacles():box({{ -9, -9, -1 }}, {{ 9, 9, 0 }})
            local stone = ground:mesh(post:derive(0), {{ -3, 0, 0 }}):sphere({{ 0, -4, 1 }}, 1.25)
            expect(ground:count(), 1) expect(stone:count(), 3)
            expect(stone:contains({{ -3, 0, 1 }}), true) expect(ground:contains({{ -3, 0, 1 }}), false)
            local Tip, Stop = module('Tip', 'turn'), module('Stop', 'share')
            local s = lsystem({{ object = turtle(){option} }})
            s:axiom(source({{ 0, 90, 180 }}), function(turn) return G(1), Pitch(90), Turn(turn), Tip(turn) end)
            s:rule('Tip(turn)', function(this, turn)
              local place = this:position()
              local share = stone:hit(place, place + this:heading())
              if share then return Stop(math.round(share * 1000) / 1000) end
              return F(1), Tip(turn)
            end)
            s:derive(5)\n"
        )
    };
    let plain = all_chains(&run_with(&script(""), divided(1, 4096)));
    let expected =
        ["F(1) F(1) F(1) F(1) F(1) Tip(0)", "Turn(90) F(1) Stop(1)", "Turn(180) F(1) F(1) Stop(0.75)"];
    assert!(expected.iter().all(|chain| plain.contains(chain)), "{plain}");
    for (threads, batch) in [(1, 1), (3, 1), (3, 2)] {
        assert_eq!(all_chains(&run_with(&script(", environment = stone"), divided(threads, batch))), plain);
    }
}

#[test]
fn misuse_is_refused_with_the_line_and_the_remedy() {
    let head = "local light = shadow_voxels() local other = shadow_voxels() local A = module('A')\n";
    let system = "local s = lsystem({ object = turtle(), environment = light }) s:axiom(A())\n";
    let of = |rest: &str| error(&format!("{head}{rest}")).replace("\n", " | ");
    let with = |rest: &str| of(&format!("{system}{rest}\ns:derive(2)"));
    let said = [
        with("s:rule('A', function(this) light:shade(this:position()) return A() end)"),
        with(
            "s:rule('A', { when = function(this) light:shade(vec(0, 0, 0)) return true end }, function() return A() end)",
        ),
        with("s:interpret('A', function(this) other:shade(this:position()) end)"),
        with("s:interpret('A', function(this) light:shade(vec(0, 0, 1e300)) end)"),
        with("light:shade(vec(0, 0, 0))"),
        of("lsystem({ object = turtle(), environment = { turtle() } })"),
        of("lsystem({ object = turtle(), environment = 3 })"),
        of("lsystem({ environment = light })"),
        of("lsystem({ object = turtle(), environment = light, interpret = 'last' })"),
        of("shadow_voxels({ size = 0 })"),
        of("attractors({ points = { vec(0, 0, 0) }, kill = -1 })"),
        of("discs({ overlap = 2 })"),
        of("soil({ cell = 0 })"),
        of("soil({ size = { 1, 0, 1 } })"),
        of("soil({ size = { 1000, 1000, 1000 } })"),
        of("soil({ amount = -1 })"),
        of("soil():take({ 0, 0, 0 }, 1, 1)"),
        of("obstacles():sphere({ 0, 0, 0 }, -1)"),
        of("obstacles():box({ 0, 0, 0 }, { 1, 1, 0 })"),
        of("obstacles():mesh(shadow_voxels())"),
        of("obstacles():prism(point(0, 0), 3)"),
        of("obstacles():nearest({ 0, 0, 0 })"),
    ];
    let after_path =
        |line: &String| line.split_once("main.lua:").map_or("", |(_, rest)| rest).to_owned() + "\n";
    let said: String = said.iter().map(after_path).collect();
    insta::assert_snapshot!(said, @r#"
    3: rule A: shadow_voxels:shade is a write method, so a rule cannot call it |   module: A, step 1 |   help: use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)
    3: rule A: shadow_voxels:shade is a write method, so a rule cannot call it |   module: A, step 1 |   help: use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)
    3: rule A (interpretation): shadow_voxels:shade changes an environment that this system does not have |   module: A, step 0 |   help: give it to the system: lsystem({ object = turtle(), environment = { light } })
    3: rule A (interpretation): shadow_voxels: the place {0.0, 0.0, 1e300} (m) is outside of the grid |   module: A, step 0 |   help: use larger voxels, or places near the origin
    3: shadow_voxels:shade is a write method, so only interpretation rules can call it |   help: use system:interpret(pattern, function(this, ...) ... end)
    2: lsystem: an environment is an object such as shadow_voxels(), not a turtle |   help: write local light = shadow_voxels(), and lsystem({ object = turtle(), environment = { light } })
    2: lsystem: an environment is an object such as shadow_voxels(), not a number |   help: write local light = shadow_voxels(), and lsystem({ object = turtle(), environment = { light } })
    2: lsystem: a system with an environment needs an object |   help: add object = turtle(), whose interpretations change the environment
    2: lsystem: interpret is "last", but rules read the environment after each step |   help: leave interpret out
    2: shadow_voxels: size is 0 |   help: give a length above 0
    2: attractors: kill is -1 |   help: give a distance (m) of at least 0
    2: discs: overlap is 2 |   help: give a part of the radius from 0 to 1
    2: soil: cell is 0 |   help: give a length (m) above 0
    2: soil: size is {1.0, 0.0, 1.0} |   help: give three lengths (m) above 0
    2: soil: the grid of 10000 by 10000 by 10000 cells is too large |   help: use larger cells
    2: soil: amount is -1 |   help: give a number of at least 0
    2: soil:take is a write method, so only interpretation rules can call it |   help: use system:interpret(pattern, function(this, ...) ... end)
    2: obstacles:sphere: the centre is {0.0, 0.0, 0.0} and the radius -1 |   help: give a radius above 0, and numbers below 1e9 m
    2: obstacles:box: the corners are {0.0, 0.0, 0.0} and {1.0, 1.0, 0.0} |   help: give a low and a high corner, with x, y and z that increase and are below 1e9 m
    2: obstacles:mesh: model must be what derive returned, or model("window.glb"), not a shadow_voxels |   help: write obstacles:mesh(model: Model, position: Vector? = the origin, scale: number | Vector? = 1)
    2: obstacles:prism: the geometry contains no area |   help: give a polygon, such as a plan
    2: obstacles:nearest: there are no obstacles |   help: add a solid: obstacles():box({ 0, 0, 0 }, { 1, 1, 2 })
    "#);
}
