"""Checks this evidence. Names: README.txt."""; import sys; del sys.path[:__name__ == "__main__"]
import base64, datetime as dt, hashlib, itertools, json, pathlib, tomllib, types, unicodedata
NOT_CHECKED = "MQTT", "routes", "words that move nothing", "code", "records of parts", "report.html"
class Wrong(Exception): "Why it is not believed."
class Story(types.SimpleNamespace): names = vetoed = plan = told = (); __getattr__ = lambda s, n: 0
def no(wrong, why="it does not follow from the blueprint and what stands before"):
	if wrong: raise Wrong(why)
def sha(raw): return hashlib.sha256(raw).hexdigest()
def once(pairs): return no(len(dict(pairs)) < len(pairs)) or dict(pairs)
def read(raw): return json.loads(raw.decode(), object_pairs_hook=once, parse_constant=no)
def plain(v): return json.dumps(v, separators=(",", ":"), ensure_ascii=False).encode()
def escape(name): return name.replace("~", "~0").replace("/", "~1")
def parts(text): return tuple(p.replace("~1", "/").replace("~0", "~") for p in text.split("/"))
def fact(text): a, _, n = text.rpartition("/"); return *parts(a), int(n) if n.isdecimal() else -1
TYPES = {list: "candidates details facts faults goals met misses operations options reasons "
	"refusals sensed sensors subs unknown", dict: "answers candidate closed configuration costs facts "
	"parameters refusal start", int: "cost deadline digit operations persons seed t", float:
	"cost deadline t taken"}; raw_of = base64.b64decode
def fits(name, v):  # text, if TYPES says nothing else; a list holds what its singular is
	kinds = [k for k in TYPES if name in TYPES[k].split()] or [str]
	if float in kinds: no(abs(v) >= 2**53)
	inner = v.values() if type(v) is dict else v if type(v) is list else ()
	return type(v) in kinds and all(fits(name[:-1], one) for one in inner)
def content(texts):  # 1 THE BLUEPRINT, from the texts that its digests are made of
	hexes, guards, (brought, own, (mine, *meaning), closure) = [*map(sha, texts)], {}, map(read, texts)
	hex, notes, hazards, *levels = closure["imported"]; known = dict(own + brought)
	no([hex, closure["behaviour"], closure["meaning"]] != hexes[:3])
	sbs = {b: branch(Story(**known[b]), dict(notes + mine).get(b, {}), known) for b in known}
	bases = {x: [(b, n) for b in sbs for n, sub in sbs[b].subs.items() if sub == x] for x in sbs}
	for one in [one for one in hazards or meaning[0] if type(one) is dict]:
		facts = [(fact(k), v) for k, v in one["facts"].items()]
		if all(b in sbs and -1 < n < sbs[b].count for (b, n), _ in facts): guards[one["name"]] = facts
	levels = {k: v for one in levels + meaning[1:] if type(one) is dict for k, v in one.items()}
	return dict(hexes=hexes, sbs=sbs, bases=bases, hazards=guards, levels=levels,
		whole=sha(plain(own + brought)), ends={b: sbs[b].goal for b in sbs})
def branch(sb, notes, known):  # the names of states hold their facts: at the end, or behind State
	sb.goal, sb.ops, (count, width, opaque) = sb.activating, notes.get("_operations", {}), sb.facts
	sb.notes, sb.facts = {int(n): note for n, note in notes.get("_facts", {}).items()}, {}
	for name in sb.states:
		at = 5 + (name[5:6] == "_") if name.startswith("State") else name.rfind("_") + 1 or -count
		text = name[at:]; cut = [text[i:i + width] for i in range(0, len(text), width or 1)]
		sb.facts[name] = [name] if opaque else cut if width else notes["_states"][name]["facts"]
	sb.count, values = len(sb.facts.get(sb.goal, ())), [*zip(*sb.facts.values())]
	sb.subs = {int(n): sub for sub, n in sb.sub_sbs if sub in known and int(n) < sb.count}
	usual = {n: "1" if {*values[n]} <= {"0", "1"} else sb.facts[sb.goal][n] for n in sb.subs}
	sb.on = {n: sb.notes.get(n, {}).get("on", usual[n]) for n in sb.subs}; return sb
def lines(raw):  # 2 THE LOG: each line, and the head, has the SHA-256 of all bytes before it
	(*told, head, end), digest, found = raw.split(b"\n"), hashlib.sha256(), []
	for number, line in enumerate(told, 1):
		digest.update(line[:-66]); link = b',"chain":"%s"}' % digest.hexdigest().encode()
		no(line[-76:] != link, f"line {number}: it was changed")
		digest.update(line[-66:] + b"\n"); found.append(read(line[:-76] + b"}"))
	sums = {"count": len(told) - 1, "hash": digest.hexdigest()}; seal = read(head).get("signed")
	no(end or head != plain({"head": sums} | ({"signed": seal} if seal else {})), "its head is wrong")
	return found[0] | {"head": plain(sums), "signed": seal}, found[1:]
def end_step(s): s.begun, s.moved, s.acting, s.failing = [], set(), 0, 0
def here(s): return s.conf | {b: at for op in s.begun if op.done for b, at in op.new.items()}
def holds(s, key, value, at, way=()):  # whether a fact has a value. None: unknown, ...: on its way
	(b, n), sb = key, s.sbs[key[0]]
	if n in sb.subs:  # the fact of a base says whether its sub-SB is in ACTIVATING
		x, on = sb.subs[n], value == sb.on[n]
		found = [...] if key in way else terms(s, at | {x: s.ends[x]}, x, way)
		return not on if False in found else None if None in found else ... if ... in found else on
	known = s.facts.get(key, sb.facts[at[b]][n] if s.began and key not in s.sensed else None)
	return None if known is None else known == value
def terms(s, at, b, way=()):  # a state check: whether each fact of the state holds
	return [holds(s, (b, n), value, at, way) for n, value in enumerate(s.sbs[b].facts[at[b]])]
def lit(s, b, n, state): return s.sbs[b].facts[state][n] == s.sbs[b].on[n]
def broken(s, at):  # the sub-SBs that disagree with a base
	return [x for x in s.bases for b, n in s.bases[x] if lit(s, b, n, at[b]) != (at[x] == s.ends[x])]
def placed(s, b, n, state):  # where a sub-SB is at a start, with its own sub-SBs
	x = s.sbs[b].subs[n]; sb = s.sbs[x]; at = sb.goal if lit(s, b, n, state) else sb.initial
	return {x: at} | {k: v for m in sb.subs for k, v in placed(s, x, m, at).items()}
def level(s, *of): return next((a[k] for a in (s.h["levels"], s.levels) for k in of if k in a), "")
def edge(s, address):  # an operation of the blueprint, and what it changes
	b, source, word = parts(address); sb, own, was = s.sbs[b], escape(word), s.conf | {b: source}
	note = sb.ops.get(own, {}) | sb.ops.get(f"{escape(source)}/{own}", {})
	op = Story(b=b, source=source, target=sb.states[source][word], note=note, t=s.t, address=address)
	diff = {n for n in range(sb.count) if sb.facts[source][n] != sb.facts[op.target][n]}
	load = note.get("subs") == "load"; op.needs = load or not diff or diff - {*sb.subs}  # an actor
	op.level, op.new = level(s, address, f"{escape(b)}/{own}") or note.get("actor"), {b: op.target}
	for n in diff & {*sb.subs} if load else (): op.new = placed(s, b, n, op.target) | op.new
	op.along = [(b, n) for n in diff] + [(x, n) for x in op.new if x != b for n in s.sbs[x].subs]
	op.crossed = [x for x in op.new if (was[x] == s.ends[x]) != (op.new[x] == s.ends[x])]; return op
def way(s): return {key for op in s.begun for sub in op.crossed for key in s.bases[sub]}
def hazards(s): return {h for h in s.hazards if all(holds(s, *f, here(s)) for f in s.hazards[h])}
def safe(s): no(hazards(s) - s.met, "a hazard is met unsaid")
def running(s, address): return [op for op in s.begun if op.address == address]
def locate(s, at): s.conf, s.vetoed = at, s.vetoed if at == s.conf else ()
IDLE = "left_out subs_bypassed operation_refused disturbed fault_injected costs_changed".split()
CAUSES = dict(resumed="resume", operation_pruned="prune", operation_restored="restore",
	reset="reset", taken_over="take_over", given_back="accept", stopped="stop", task_answered="answer",
	fault_injected="inject", disturbed="disturb"); PARTS = "brought behaviour meaning closure".split()
def take(s, e):  # 3 THE STORY is told again, event by event: when it may not come, what it changes
	no(not all(fits(k, v) for k, v in e.items() if (k, v) != ("value", None)), "of another type")
	e, kind, c = types.SimpleNamespace(**e), e["event"], s.cause
	waits = s.start or s.begun or s.tasks or s.latch or s.held or s.paused or s.by_hand or not s.began
	no(s.over or s.start and kind not in {"measured", *IDLE[:1], "fact_changed", "state_checked"} or
		e.t < s.t or e.t > s.t and not (waits or {*s.goals.values()} & {*s.conf.items()}))
	own = vars(c) | vars(e) if kind in CAUSES else {}  # as its command says
	no(own and ((c.t, c.command, c.by, c.address) != (e.t, CAUSES[kind], own["by"], own["address"]) or
		c.refused and kind != "task_answered" and "the world is gone" not in c.refused)); s.t = e.t
	kind in IDLE + ["measured"] or globals()["on_" + kind](s, e); c.t = -1 if own else c.t
	if kind != "measured": s.last, s.checked = e, s.checked if kind == "state_checked" else {}
	if kind not in ("measured", "fact_changed", "costs_changed", "goal_reached"): s.busy = e.t
def on_within(s, e):  # what it runs has its own story
	op, one = running(s, e.operation)[-1], read(raw := e.told.encode()); run = op.note["binding"]
	h, closure = s.h | {"goals": [run["goal"]], "levels": {}}, s.h["procedures"][run["blueprint"]]
	op.below = op.below or story(s.known, closure, h, one.get("start", {}))
	no(op.outcome or one["t"] != e.t or plain(one) != raw and b"\\u" not in raw); take(op.below, one)
def on_run_started(s, e):  # bases decide where their sub-SBs stand
	roots = {b: s.ends[b] for b in s.sbs if not s.bases[b]}; s.h["met"] = vars(e).get("met", ())
	s.goals, s.sensed = {goal: parts(goal) for goal in e.goals}, {*map(fact, e.sensed)}
	no(s.began or (e.behaviour, e.world, e.seed) != (s.whole, s.h["world"], s.h["seed"]) or
		dict(s.goals.values()) != (dict(map(parts, s.h["goals"])) or roots) or s.facts and not s.names)
	usual = {b: x if s.bases[b] and x == s.ends[b] else s.sbs[b].initial for b, x in e.start.items()}
	no(e.start != usual | s.given | s.conf); s.conf, s.start, s.began = {**e.start}, {**e.start}, 1
	no(s.conf.keys() != s.sbs.keys() or broken(s, s.conf) or hazards(s))
def on_fact_changed(s, e):  # a source or a person tells it
	key = b, n = e.branch, e.digit; sb, name, v = s.sbs[b], f"{escape(b)}/{n}", e.value
	who = level(s, name) or sb.notes.get(n, {}).get("aggregation")
	no(not -1 < n < sb.count or s.facts.get(key, 0) == v or v is not None and (e.reason or n in sb.subs
		or s.began and key not in s.sensed or who == "human" and s.said.get(("fact", name)) != (e.t, v)))
	s.facts[key] = v; s.met &= hazards(s)
def on_state_checked(s, e):
	b, state = parts(e.address); seen = terms(s, here(s) | {b: state}, b, way(s))
	no((len(e.misses), len(e.unknown)) != (seen.count(False), seen.count(None)) or
		e.result != ("false" if e.misses else "unknown" if e.unknown else "true"))
	if s.start: return no(([*s.start][0], s.start.pop(b), e.result) != (b, state, "true"))
	no(s.acting or s.failing or b in s.checked or not any(op.new.get(b) == state for op in s.begun)
		or way(s) - {key for op in s.begun for key in op.along}); s.failing = e.result != "true"
	if not s.failing: safe(s); s.checked[b] = state
	for op in s.begun: op.done |= not s.failing and op.b == b and op.target == state
def on_route_planned(s, e): no(s.last.event == e.event); s.free = s.ask = 0; *s.plan, = e.operations
def on_operation_started(s, e):  # from where its SB is
	a, op, now, others = e.address, edge(s, e.address), here(s), s.begun; op.function = e.function
	s.free, on, seen = s.free or s.ask == a, s.plan[:1] == [a], terms(s, now, op.b, way(s))
	no(op.target != e.target or now[op.b] != op.source or a in s.shut or s.failing or s.tasks or
		not s.free and (not on or s.paused or a in s.vetoed) or False in seen or s.latch or
		None in seen and not others or s.acting and s.last.event != e.event or
		any((o.outcome or o.b == op.b) and not o.done for o in others))
	yes, go = (s.said.pop((kind, a), "  ")[1] for kind in ("confirm", "supervise")); safe(s)
	no(op.needs and bool(e.function) == (op.level == "human") or go != "go_on" and
		not (others or s.free or s.bases[op.b]) and level(s, "supervision") == "human")
	no(yes != "confirm" and (op.level == "shared" or op.note.get("confirm")) or not all(fact(key)[0] in
		s.moved or holds(s, fact(key), v, now) for key, v in op.note.get("requires", {}).items()))
	s.begun, s.plan, s.acting, s.held, s.ask = [*others, op], s.plan[on:], 1, 0, 0
def on_operation_ended(s, e, goal="goal_reached"):  # what it runs is there
	op, how = running(s, e.address)[-1], e.outcome; bad, s.acting = how != "returned", 0
	no(not bad and op.function and "blueprint" in op.note.get("binding", ()) and op.below.over != goal)
	no(op.outcome or s.failing or how != "cancelled" and not (op.function or op.answer) or not bad and
		op.answer != "done" and (op.answer != 0 or e.t <= op.t)); op.outcome, s.failing = how, bad
def on_committed(s, e):  # all ended well, and were checked
	ops = [s.begun.pop(s.begun.index(running(s, a)[0])) for a in e.operations]
	new = {b: at for op in ops for b, at in op.new.items()}; at = s.conf | new
	no(not ops or s.failing or s.last.t != e.t or e.configuration != new or broken(s, at) or any(
		(op.function or op.answer) and not op.outcome for op in ops) or new.items() - s.checked.items())
	locate(s, at); safe(s); s.moved, s.count = s.moved | {*new}, s.count + len(ops)
	if not (s.begun or any(s.bases[b] or s.sbs[b].subs for b in new)): s.free, s.moved = 0, set()
def on_operation_risky(s, e):
	no(s.last.event != e.event and not (s.failing and running(s, e.address))); s.begun = []
def on_operation_pruned(s, e): s.shut |= {e.address}
def on_operation_restored(s, e): s.shut, s.vetoed = s.shut - {e.address}, ()
def on_mismatch(s, e): no(not e.facts or type(e.facts) is dict); end_step(s); s.only = e.candidates
def on_relocalised(s, e):
	there, c, last, adopts = e.configuration, s.cause, s.last, s.h["on_mismatch"] == "adopt"
	moved = [b for b in there if there[b] != s.conf.get(b)]
	adopts = (c.command, c.t) == ("adopt", e.t) or adopts and last.event == "mismatch"
	may = adopts and s.only == [there] or last.event == "given_back" and last.configuration == there
	s.facts = {k: v for k, v in s.facts.items() if v or not s.began or k in s.sensed}
	no(s.conf and moved and not (may or len(moved) == 1 and s.bases[moved[0]]) or last.event == e.event
		or s.acting or broken(s, there) or not all(all(terms(s, there, b)) for b in {**s.sbs, **there}))
	locate(s, there); end_step(s); s.held, s.only = 0, 0
def arrived(s): no(not s.began or s.begun or s.held or s.latch or s.busy >= s.t or any(
	False in terms(s, s.conf, b) for b in s.conf) or {s.goals[g] for g in s.told} - {*s.conf.items()})
def on_goal_reached(s, e):
	s.told = [*s.told, e.goal]; arrived(s); safe(s)
	no([*s.goals][:len(s.told)] != s.told or not all(terms(s, s.conf, s.goals[e.goal][0])))
def on_hazard_met(s, e): no({fact(k): v for k, v in e.facts.items()} != dict(s.hazards[e.name]) or
	e.name not in hazards(s)); s.met |= {e.name}
def on_held(s, e): end_step(s); s.held, s.paused = (e.kind, e.reason), 0
def on_commanded(s, e):
	no(not e.by or e.value is None); s.cause, word = e, "" if e.refused else e.command
	if word in ("resume", "step"): s.paused, s.vetoed = 0, () if s.held else s.vetoed
	if word == "veto" and not s.begun: s.vetoed = *s.vetoed, e.address
	if word == "ask": s.ask = e.address
	if word in ("ask", "step", "stop", "set_automatic", "set_cost"): s.by_hand = 1
def on_paused(s, e): s.paused, s.held = e.event == "paused", 0
def on_stopped(s, e): end_step(s); s.latch, s.by, s.held, s.ask, s.tasks = e.event, e.by, 0, 0, {}
def on_reset(s, e): no(not s.latch); s.latch, s.paused = 0, e.event == "reset"
on_taken_over, on_given_back, on_resumed = on_stopped, on_reset, on_paused
def on_task_opened(s, e):  # it asks those whom the blueprint names
	kind, (b, n) = e.kind, fact(e.address) if e.kind == "fact" else ("", 0)
	note = s.sbs[b].notes.get(n, {}) if b else {} if kind == "start" else edge(s, e.address).note
	roles = kind != "supervise" and note.get(kind if kind == "confirm" else "roles") or [""]
	no(e.task in s.names or e.role != ", ".join(filter(None, roles)) or e.persons != len(roles))
	if kind == "operation": running(s, e.address)[-1].answer = "open"
	s.tasks[e.task], s.names = Story(e=e, roles=roles, given={}, also=""), {*s.names, e.task}
def on_task_escalated(s, e): s.tasks[e.task].also = e.role
def same(name): return "".join(unicodedata.normalize("NFKC", name).casefold().split())
def each(wishes, offers, fits):  # each wish gets its own offer
	return any(all(map(fits, wishes, some)) for some in itertools.permutations(offers, len(wishes)))
def on_task_answered(s, e):  # another person, in a role
	if no(s.cause.refused != e.refused or s.cause.value not in ("", e.task)) or e.refused: return
	task = s.tasks[e.task]; no(same(e.by) in map(same, task.given) or e.t >= task.e.deadline)
	task.given[e.by], also, roles = same(e.role), same(task.also), map(same, task.roles)
	no(not each(task.given.values(), roles, lambda one, seat: not seat or one in (seat, also or seat)))
def on_task_closed(s, e):  # with the answers of all
	task, said, good = s.tasks.pop(e.task), {*e.answers.values()}, e.outcome == "answered"
	no(e.answers and (e.answers.keys() != task.given.keys() or not said <= {*task.e.options}) or
		e.outcome == "timed_out" and e.t < task.e.deadline - 1e-5 or
		good and (said != {e.answer} or len(task.given) != task.e.persons)); about = task.e.address
	if good: s.said[task.e.kind, about] = e.t, e.answer
	for op in running(s, about)[-1:] if good else (): op.answer = e.answer
def on_run_finished(s, e, goal="goal_reached"):
	(kind, held), late, why, r = s.held or ("", ""), s.last.t != e.t, e.sentence, e.reason; s.over = r
	cut = why.startswith(("The window let go", "Stopped in the middle", "Stopped before the run"))
	no(not why or s.conf and e.configuration != s.conf or s.tasks and r != "failed" and not cut or
		e.operations != s.count or late and (not (cut or s.h["attended"]) or s.last.event == r == goal))
	if r == goal: arrived(s); no(s.told != [*s.goals] or why.find(", ".join(s.told) + " hold"))
	elif r == "no_route": no((kind, held) != (r, why))
	elif r == "held": no((kind == "no_route" or held != why) and "nobody is there to " not in why)
	elif r == "refused": no(s.count or s.begun or s.began and ("start", "") not in s.said)
	elif r == "stopped": no(not cut and (s.latch != r or why.find(f"Stopped by {s.by}.")))
	else: no(r != "failed" or late or not s.last.event == kind == "held" or held != why)
def story(known, closure, h, given):  # that has not begun
	return Story(**known[closure], known=known, h=h, given=given, shut={*h["avoid"]}, conf={},
		facts={}, said={}, tasks={}, begun=[], moved=set(), met=set(), last=Story(), cause=Story())
def tell(known, raw, files=()):
	h, events = lines(raw); said = h["digests"]
	sums, log = {said["file"], *said.get("imported", {}).values()}, b'{"log":"smsl-run","version":3,'
	right = [said[part] for part in PARTS[1:]] in [c["hexes"][1:] for c in known.values()]
	no(not (right and raw.startswith(log) and sums <= (files or sums)), "its blueprint is not here")
	s = story(known, said["closure"], h, dict(map(parts, h["start"]))); s.by_hand = h["by_hand"]
	for number, event in enumerate(events, 2):
		try: take(s, event)
		except Exception as error: raise Wrong(f"line {number}: {event.get('event')}: {error}")
	no(not s.over, "it has no end"); return h
def when(at): return dt.datetime.fromisoformat(at + "T23:59:59Z" * ("T" not in at))
def ring(them): return {"sha256:" + sha(raw_of(k)): p | {"key": k} for p in them for k in p["keys"]}
def trusted():  # 4 THE RECORDS: the policy, and whose keys count
	policy = tomllib.loads(load("policy.toml").decode()); own = policy.get("register_key")
	mine = own and opened(read(load("register.json")), ring([{"keys": [own]}]), "smsl-studio.register")
	return policy, ring(read(mine[0] if own else load("keys.json"))["persons"])
def opened(envelope, keys, kind="in-toto"):
	from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey as Key
	(one,), kind = envelope["signatures"], f"application/vnd.{kind}+json"; name = one["keyid"]
	body, sig = raw = raw_of(envelope["payload"]), raw_of(one["sig"]); key = keys[name]
	text, own = [base64.b64encode(each).decode() for each in raw]; own = [{"keyid": name, "sig": own}]
	no(envelope != {"payload": text, "payloadType": kind, "signatures": own})
	signed = b"DSSEv1 %d %b %d %b" % (len(kind), kind.encode(), len(body), body)
	Key.from_public_bytes(raw_of(key["key"])).verify(sig, signed); return body, key
def void(key, at, policy, *sums):  # revoked, or not valid at that time
	revoked = {one[-64:] for one in policy.get("revoked", ())} & {sha(raw_of(key["key"])), *sums}
	return revoked or key.get("revoked") or at > when(key.get("until") or "9999-12-30")
def recorder(log):  # the machine that has signed the head of its log
	if not log.get("signed"): return "nobody"
	policy, keys = trusted(); body, key = opened(log["signed"], keys, "smsl-studio.log-head")
	bad = key["roles"] != ["recorder"] or void(key, when(log["wall_time"]), policy)
	return no(bad or body != log["head"]) or key["person"]
def judge(known, log, bot={"automatic", "recorder"}):
	(policy, keys), last, ask, before = trusted(), {}, [], when("1999-01-01")
	told = [opened(one, keys) for f in files("records/*") for one in read(f.read_bytes())["records"]]
	day = when(log["wall_time"] if log else read(told[-1][0])["predicate"]["time"])
	days = dt.timedelta(policy.get("valid_days", 1e5))
	for body, key in told:  # each person's last word counts
		say, sums = read(body)["predicate"], [one["digest"] for one in read(body)["subject"]]
		at, who, may, met = when(say["time"]), same(key["person"]), {*map(same, key["roles"])}, say["met"]
		no(at <= before, "order"); before, my = at, sums[0]
		if at > day + dt.timedelta(minutes=5): continue  # signed later
		gone = void(key, at, policy, sha(body), *(hex for one in sums for hex in one.values()))
		word = not gone and log.get("digests", my)["closure"] == my["closure"] in known and say["verdict"]
		good = word and day <= min(at + days, when(say["expires"] or "9999-12-30"))
		no(good and may & bot and policy.get("automatic") != "may_sign", "a program signs")
		last[who] = word if word == "rejected" else good and not may & bot and may
		ask = [a for a in ask if (a[0] != who or met) and not (last[who] and a[1] in met and a[2] & may)]
		ask += [(who, text, may) for text in say["conditions"] if last[who]]
	no("rejected" in last.values(), "rejected")
	seats = [same(role) for role, n in policy.get("roles", {}).items() for _ in range(min(n, 99))]
	ok = [*filter(None, last.values())]; few = len(ok) < max(1, policy.get("persons", len(seats)))
	no(few or not each(seats, ok, lambda seat, may: seat in may), "too few sign")
	for a in ask: no(last[a[0]] and a[1] not in log.get("met", ()), "a condition is open: " + a[1])
def files(way): return sorted(f for f in pathlib.Path().glob(way) if f.is_file() > f.is_symlink())
def load(name): return b"".join(one.read_bytes() for one in files(name))
def main():  # 5 THE FOLDER: all of it is checked, and nothing else
	wrong, records = [], files("records/*"); said = [f"Not checked: {one}." for one in NOT_CHECKED]
	def tried(place, act, *given):
		try: return act(*given)
		except Exception as error: wrong.append(f"{place}: {str(error) or repr(error)}"[:500])
	known = {c["hexes"][3]: c for one in files("content/**/closure.json") if (c := tried(
		one, lambda: content([one.with_stem(part).read_bytes() for part in PARTS])))}
	hexes = {Wrong, *(tried(one, lambda: sha(one.read_bytes())) for one in files("blueprint/**/*"))}
	logs = [tried(one, lambda: tell(known, one.read_bytes(), hexes)) or {} for one in files("logs/*")]
	said += [f"The head of a log is signed by {tried('head', recorder, log)}." for log in logs]
	if records or files("policy.toml"): [tried("records", judge, known, log) for log in logs or [{}]]
	said += ["No log."] * (not logs) + ["No policy: one signature counts."] * (not load("policy.toml"))
	if not records: said += ["No record: nobody has approved this blueprint."]
	for line in *said, *wrong, "Not consistent." if wrong else "Consistent.": print(ascii(line)[1:-1])
	return bool(wrong)
if __name__ == "__main__": sys.exit(main())
